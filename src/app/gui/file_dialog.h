// The system's file dialog, without waiting for it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

namespace clothlab::app {

class FileDialog {
public:
    enum class Purpose { open, save, texture };
    /// Shows the dialog.
    FileDialog(Purpose purpose, const std::filesystem::path& start);
    ~FileDialog();

    /// Whether this system has file dialogs.
    static bool available();

    Purpose purpose() const { return purpose_; }
    /// Whether the user is done.
    bool ready() const;
    /// What the user chose; nothing when the dialog was cancelled. Call once, when ready.
    std::optional<std::filesystem::path> result();

private:
    struct Parts;
    Purpose purpose_;
    std::unique_ptr<Parts> parts_;
};

} // namespace clothlab::app
