#include "app/gui/file_dialog.h"

#include <portable_file_dialogs.h>

namespace clothlab::app {

struct FileDialog::Parts {
    std::unique_ptr<pfd::open_file> open;
    std::unique_ptr<pfd::save_file> save;
};

FileDialog::FileDialog(Purpose purpose, const std::filesystem::path& start)
    : purpose_(purpose), parts_(std::make_unique<Parts>()) {
    const std::vector<std::string> filters{"Scenes", "*.json", "All files", "*"};
    if (purpose == Purpose::texture)
        parts_->open = std::make_unique<pfd::open_file>(
            "Choose a picture", start.parent_path().string(),
            std::vector<std::string>{"Pictures", "*.png *.jpg *.jpeg *.hdr", "All files", "*"});
    else if (purpose == Purpose::open)
        parts_->open = std::make_unique<pfd::open_file>("Open a scene", start.string(), filters);
    else
        parts_->save = std::make_unique<pfd::save_file>("Save the scene", start.string(), filters);
}

FileDialog::~FileDialog() {
    // The dialog's process would be waited for otherwise.
    if (parts_->open && !parts_->open->ready(0))
        parts_->open->kill();
    if (parts_->save && !parts_->save->ready(0))
        parts_->save->kill();
}

bool FileDialog::available() {
    return pfd::settings::available();
}

bool FileDialog::ready() const {
    return parts_->open ? parts_->open->ready(0) : parts_->save->ready(0);
}

std::optional<std::filesystem::path> FileDialog::result() {
    std::string file;
    if (parts_->open) {
        const std::vector<std::string> files = parts_->open->result();
        if (!files.empty())
            file = files.front();
    } else {
        file = parts_->save->result();
    }
    if (file.empty())
        return std::nullopt;
    return file;
}

} // namespace clothlab::app
