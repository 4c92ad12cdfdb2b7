// JSON that remembers where everything stood, so that errors can name the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/error.h"

namespace clothlab::scene {

struct Node {
    enum class Type : std::uint8_t { null, boolean, number, string, array, object };
    Type type = Type::null;
    bool boolean = false;
    double number = 0;
    std::string text;
    std::vector<Node> items;
    std::vector<std::pair<std::string, Node>> members; ///< in the order of the file
    std::size_t line = 0;                              ///< 1-based; where the value, or its key, stands

    // Not here: Clang would need the whole pair of `members` for them, of which this is a part.
    Node();
    Node(const Node&);
    Node(Node&&) noexcept;
    Node& operator=(const Node&);
    Node& operator=(Node&&) noexcept;
    ~Node();

    /// The member of a name, or nullptr.
    const Node* find(std::string_view name) const;
};

/// "an object", "a number", ...
std::string_view describe(Node::Type type);

/// A parsed text. Nesting is limited to 32 levels and objects to 1000 keys, which may not repeat.
struct Document {
    std::string source; ///< name for messages
    Node root;

    /// Throws SceneError with the place when the text is not JSON, is empty or breaks a limit.
    static Document parse(std::string_view text, std::string source);

    /// Throws a SceneError for a place in this document; `key` may be empty.
    [[noreturn]] void fail(const Node& at, const std::string& key, const std::string& what) const;
};

} // namespace clothlab::scene
