// The texts of the shader panel, one editor for each file, whatever shader is chosen: what is typed is never lost by
// looking at something else.
#pragma once

#include <TextEditor.h>

#include <map>
#include <string>
#include <vector>

#include "ui/lab.h"

namespace clothlab::ui {

struct ShaderEditor {
    TextEditor text;
    std::string saved;     ///< the file's text when it was last looked at
    bool modified = false; ///< differs from it
    bool conflict = false; ///< the file was changed by others while this was modified
    double typed_at = -1;  ///< when, in ImGui's time; -1: nothing that the picture does not show already
    std::vector<ShaderFault> marked;
};

struct ShaderEditors {
    std::map<std::string, ShaderEditor> by_name;
    std::string shader;   ///< whose first file was brought to the front
    std::string to_front; ///< a file whose tab is to be selected
    std::string new_name; ///< typed into the window for a new shader
    int quit_in = -1;     ///< frames until the lab is closed after all was saved; -1: it is not
};

/// The panel's state, made when it is first asked for.
ShaderEditors& shader_editors(Lab& lab);

/// Makes an editor for a file that has none; one that has no changes takes the file's new text; marks the faults.
void follow_shader_files(Lab& lab);

/// Has the picture drawn with what was typed, once there is a pause.
void pass_on_shader_edits(Lab& lab);

/// Notes that an editor's text was changed by its user.
void shader_typed(ShaderEditor& editor);

/// Back to the file's text; the editor's undo brings back what was typed.
void revert_shader(ShaderEditor& editor);

} // namespace clothlab::ui
