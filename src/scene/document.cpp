#include "scene/document.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

namespace clothlab::scene {
namespace {

constexpr std::size_t max_depth = 32;
constexpr std::size_t max_keys = 1000; ///< in one object: finding a repeated one takes quadratic time

/// nlohmann's SAX callbacks do not say where they are, so the input iterator does: it reports how far it has been read.
struct TrackedIterator {
    using iterator_category = std::forward_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;
    const char* at;
    const char** reached;
    reference operator*() const { return *at; }
    TrackedIterator& operator++() {
        *reached = ++at;
        return *this;
    }
    TrackedIterator operator++(int) {
        const TrackedIterator old = *this;
        ++*this;
        return old;
    }
    bool operator==(const TrackedIterator& other) const { return at == other.at; }
    bool operator!=(const TrackedIterator& other) const { return at != other.at; }
};

/// Builds the tree with an explicit stack: the parser does not recurse, and neither does this.
class Builder : public nlohmann::json_sax<nlohmann::json> {
public:
    Builder(std::string_view text, const char*& reached) : text_(text), reached_(reached) {}

    bool null() override { return add({}, here()); }
    bool boolean(bool value) override {
        Node n;
        n.type = Node::Type::boolean;
        n.boolean = value;
        return add(std::move(n), here());
    }
    bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return number(value); }
    bool string(string_t& value) override {
        Node n;
        n.type = Node::Type::string;
        n.text = std::move(value);
        return add(std::move(n), here());
    }
    bool binary(binary_t&) override { return false; } // JSON text has none
    bool start_object(std::size_t) override { return open(Node::Type::object); }
    bool start_array(std::size_t) override { return open(Node::Type::array); }
    bool key(string_t& name) override {
        Node& object = *stack_.back();
        if (object.members.size() >= max_keys)
            return fail("more than " + std::to_string(max_keys) + " keys in one object", here());
        if (object.find(name))
            return fail("the key \"" + name + "\" stands twice", here());
        object.members.emplace_back(std::move(name), Node{});
        object.members.back().second.line = line(here());
        return true;
    }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }
    bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& e) override {
        const bool overflow = dynamic_cast<const nlohmann::detail::out_of_range*>(&e) != nullptr;
        std::string what = overflow ? "a number that no double can hold" : "not valid JSON";
        const std::size_t at = position > 0 ? position - 1 : 0;
        if (position > text_.size() && !overflow) // it has read beyond the last character
            what += ": the text ends too early";
        else if (!token.empty())
            what += " at \"" + token.substr(token.size() > 40 ? token.size() - 40 : 0) + "\"";
        return fail(what, std::min(at, text_.size()));
    }

    Node root;
    std::optional<std::pair<std::size_t, std::string>> error; ///< line and sentence

private:
    std::size_t here() const { return static_cast<std::size_t>(reached_ - text_.data()); }
    /// Counts on from where it was asked last; from the start each time would take quadratic time.
    std::size_t line(std::size_t offset) {
        const auto [from, to] = std::minmax(offset, counted_);
        const auto newlines = static_cast<std::size_t>(std::ranges::count(text_.substr(from, to - from), '\n'));
        line_ = offset >= counted_ ? line_ + newlines : line_ - newlines;
        counted_ = offset;
        return line_;
    }
    bool fail(std::string what, std::size_t offset) {
        error = {line(offset), std::move(what)};
        return false;
    }
    bool number(double value) {
        Node n;
        n.type = Node::Type::number;
        n.number = value;
        // The lexer has looked one character past the number, which may have been the end of its line.
        return add(std::move(n), here() - (here() > 0 ? 1u : 0u));
    }
    Node* place(Node node, std::size_t offset) {
        if (stack_.empty()) {
            root = std::move(node);
            root.line = line(offset);
            return &root;
        }
        Node& parent = *stack_.back();
        if (parent.type == Node::Type::array) {
            parent.items.push_back(std::move(node));
            parent.items.back().line = line(offset);
            return &parent.items.back();
        }
        Node& member = parent.members.back().second;
        node.line = member.line; // a member stands where its key stands
        member = std::move(node);
        return &member;
    }
    bool add(Node node, std::size_t offset) {
        place(std::move(node), offset);
        return true;
    }
    bool open(Node::Type type) {
        if (stack_.size() >= max_depth)
            return fail("nested deeper than " + std::to_string(max_depth) + " levels", here());
        Node n;
        n.type = type;
        stack_.push_back(place(std::move(n), here()));
        return true;
    }
    bool close() {
        stack_.pop_back();
        return true;
    }

    std::string_view text_;
    const char*& reached_;
    std::size_t counted_ = 0, line_ = 1;
    // Pointers into vectors stay valid: only the innermost open node grows.
    std::vector<Node*> stack_;
};

} // namespace

Node::Node() = default;
Node::Node(const Node&) = default;
Node::Node(Node&&) noexcept = default;
Node& Node::operator=(const Node&) = default;
Node& Node::operator=(Node&&) noexcept = default;
Node::~Node() = default;

const Node* Node::find(std::string_view name) const {
    for (const auto& [key, value] : members)
        if (key == name)
            return &value;
    return nullptr;
}

std::string_view describe(Node::Type type) {
    switch (type) {
    case Node::Type::null:
        return "null";
    case Node::Type::boolean:
        return "true or false";
    case Node::Type::number:
        return "a number";
    case Node::Type::string:
        return "a text";
    case Node::Type::array:
        return "a list";
    case Node::Type::object:
        return "an object";
    }
    return "";
}

Document Document::parse(std::string_view text, std::string source) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw SceneError(source + ": the file is empty; a scene is one JSON object with at least \"cloth\"");
    const char* reached = text.data();
    Builder builder(text, reached);
    const TrackedIterator first{text.data(), &reached}, last{text.data() + text.size(), &reached};
    if (!nlohmann::json::sax_parse(first, last, &builder)) {
        const auto [line, what] = builder.error.value_or(std::pair<std::size_t, std::string>{1, "not valid JSON"});
        throw SceneError(source + ":" + std::to_string(line) + ": " + what);
    }
    return {std::move(source), std::move(builder.root)};
}

void Document::fail(const Node& at, const std::string& key, const std::string& what) const {
    throw SceneError(source + ":" + std::to_string(at.line) + ": " + (key.empty() ? "" : key + ": ") + what);
}

} // namespace clothlab::scene
