// Live shader work: watches the files, draws with texts that are being typed, saves and copies shaders, and tells the
// panels what is wrong.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "app/core/shader_watch.h"
#include "render/renderer.h"
#include "ui/lab.h"

namespace clothlab::app {

class ShaderDesk {
public:
    /// `user_folder`, where changed and new shaders are saved, is the renderer's first folder, or empty. Files are
    /// looked at every so many seconds.
    ShaderDesk(render::Renderer& renderer, ui::Lab& lab, std::filesystem::path user_folder, double seconds);

    /// Before panels are drawn: takes changed files and tells the panels which there are.
    void update();
    void carry_out(const ui::ShaderRequest& request);
    /// Whether shaders may have changed since the last call: the picture is then to be drawn anew.
    bool take_changed();
    /// After a draw: what was wrong with its shaders. `chosen` is the error of a shader that has never been right.
    void tell(const render::ShaderError* chosen);

private:
    void carry_out(const ui::EditShader& r);
    void carry_out(const ui::SaveShader& r);
    void carry_out(const ui::CopyShader& r);
    void carry_out(const ui::UseShippedShader& r);
    void reload();
    void list_shaders();
    void list_files();
    std::string name_of(const std::filesystem::path& file) const;
    bool is_shipped(const std::filesystem::path& file) const;
    void save(const std::string& name, const std::string& text);

    render::Renderer& renderer_;
    ui::Lab& lab_;
    std::filesystem::path user_folder_;
    double seconds_;
    ShaderWatch watch_;
    std::map<std::string, std::string> edited_;              ///< unsaved texts by the files' names
    std::map<std::string, render::ShaderFault> misdeclared_; ///< by shader
    std::string listed_;                                     ///< the shader whose files the panels are shown
    bool changed_ = true, files_changed_ = true;
};

} // namespace clothlab::app
