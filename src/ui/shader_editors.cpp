#include "ui/shader_editors.h"

#include <algorithm>
#include <imgui.h>

namespace clothlab::ui {
namespace {

/// GLSL as the editor knows it, with types, stage variables and built-in functions told apart.
const TextEditor::Language& glsl() {
    static const TextEditor::Language language = [] {
        TextEditor::Language l = *TextEditor::Language::Glsl();
        for (const char* type : {"void", "bool",  "int",   "uint",      "float",       "vec2",           "vec3",
                                 "vec4", "ivec2", "ivec3", "ivec4",     "bvec2",       "bvec3",          "bvec4",
                                 "mat2", "mat3",  "mat4",  "sampler2D", "samplerCube", "sampler2DShadow"}) {
            l.keywords.erase(type);
            l.declarations.insert(type);
        }
        for (const char* known : {"abs",          "acos",         "all",
                                  "any",          "asin",         "atan",
                                  "ceil",         "clamp",        "cos",
                                  "cross",        "dFdx",         "dFdy",
                                  "degrees",      "distance",     "dot",
                                  "exp",          "exp2",         "faceforward",
                                  "floor",        "fract",        "fwidth",
                                  "inverse",      "inversesqrt",  "length",
                                  "log",          "log2",         "max",
                                  "min",          "mix",          "mod",
                                  "normalize",    "pow",          "radians",
                                  "reflect",      "refract",      "round",
                                  "sign",         "sin",          "smoothstep",
                                  "sqrt",         "step",         "tan",
                                  "texelFetch",   "texture",      "textureLod",
                                  "textureSize",  "transpose",    "trunc",
                                  "gl_FragCoord", "gl_Position",  "gl_FrontFacing",
                                  "gl_VertexID",  "gl_PointSize", "gl_PointCoord",
                                  "gl_in",        "EmitVertex",   "EndPrimitive"})
            l.identifiers.insert(known);
        return l;
    }();
    return language;
}

TextEditor::Palette palette() {
    TextEditor::Palette p = TextEditor::GetDarkPalette();
    const auto set = [&](TextEditor::Color what, ImU32 colour) { p[static_cast<std::size_t>(what)] = colour; };
    set(TextEditor::Color::background, IM_COL32(25, 27, 30, 255)); // darker than the panel, as an editor is
    set(TextEditor::Color::punctuation, IM_COL32(200, 204, 210, 255));
    set(TextEditor::Color::preprocessor, IM_COL32(224, 140, 106, 255));
    set(TextEditor::Color::identifier, IM_COL32(222, 226, 232, 255));
    return p;
}

/// Puts a text in place of the editor's: a step that its undo takes back, with the cursor where it was.
void replace(ShaderEditor& editor, const std::string& text) {
    const TextEditor::DocPos cursor = editor.text.GetMainCursorPosition();
    const std::size_t last = editor.text.GetLineCount() - 1;
    editor.text.ReplaceSectionText({0, 0}, {last, editor.text.GetLineText(last).size()}, text);
    editor.text.SetCursor(cursor);
}

void follow(ShaderEditor& editor, const ShaderFile& file, bool is_new) {
    if (is_new) {
        editor.text.SetLanguage(&glsl());
        editor.text.SetPalette(palette());
        editor.text.SetInsertSpacesOnTabs(true);
        editor.text.SetShowWhitespacesEnabled(false);
        editor.text.SetCompletePairedGlyphs(false);
        editor.text.SetText(file.saved);
        editor.saved = file.saved;
        return;
    }
    if (file.saved == editor.saved)
        return;
    editor.saved = file.saved;
    const bool differs = editor.text.GetText() != file.saved;
    if (editor.modified && differs) {
        editor.conflict = true;
        return;
    }
    if (differs)
        replace(editor, file.saved);
    editor.modified = editor.conflict = false;
}

void mark(ShaderEditor& editor, const ShaderFile& file, const std::vector<ShaderFault>& all) {
    std::vector<ShaderFault> faults;
    for (const ShaderFault& fault : all)
        if (fault.file == file.file && fault.line > 0)
            faults.push_back(fault);
    if (faults == editor.marked)
        return;
    editor.text.ClearMarkers();
    for (auto fault = faults.begin(); fault != faults.end(); ++fault) {
        const auto same_line = [&](const ShaderFault& f) { return f.line == fault->line; };
        if (std::find_if(faults.begin(), fault, same_line) != fault)
            continue; // told with the line's first
        std::string text;
        for (const ShaderFault& f : faults)
            if (same_line(f))
                text += (text.empty() ? "" : "\n") + f.text;
        editor.text.AddMarker(static_cast<std::size_t>(fault->line - 1), IM_COL32(196, 62, 58, 255),
                              IM_COL32(196, 62, 58, 80), text, text);
    }
    editor.marked = std::move(faults);
}

} // namespace

std::string place_of(const ShaderWork& work, const ShaderFault& fault) {
    std::string place = fault.file.string();
    for (const ShaderFile& file : work.files)
        if (file.file == fault.file)
            place = file.name;
    return fault.line > 0 ? place + ":" + std::to_string(fault.line) : place;
}

ShaderEditors& shader_editors(Lab& lab) {
    if (!lab.shader_work.editors)
        lab.shader_work.editors = std::make_shared<ShaderEditors>();
    return *lab.shader_work.editors;
}

void follow_shader_files(Lab& lab) {
    ShaderEditors& editors = shader_editors(lab);
    // Nobody looks at a closed panel: editors are made when it is opened.
    const bool open = lab.open[static_cast<std::size_t>(PanelId::shader)];
    for (const ShaderFile& file : lab.shader_work.files) {
        const bool is_new = !editors.by_name.contains(file.name);
        if (is_new && !open)
            continue;
        ShaderEditor& editor = editors.by_name[file.name];
        follow(editor, file, is_new);
        mark(editor, file, lab.shader_work.faults);
    }
}

void shader_typed(ShaderEditor& editor) {
    editor.modified = editor.text.GetText() != editor.saved;
    editor.conflict = editor.conflict && editor.modified;
    editor.typed_at = ImGui::GetTime();
}

void revert_shader(ShaderEditor& editor) {
    replace(editor, editor.saved);
    shader_typed(editor);
    editor.typed_at = 0; // at once
}

void pass_on_shader_edits(Lab& lab) {
    for (auto& [name, editor] : shader_editors(lab).by_name) {
        if (editor.typed_at < 0 || ImGui::GetTime() - editor.typed_at < lab.shader_work.pause_s)
            continue;
        editor.typed_at = -1;
        if (editor.modified)
            lab.ask(EditShader{name, editor.text.GetText()});
        else
            lab.ask(EditShader{name, std::nullopt});
    }
}

bool has_unsaved_shaders(const Lab& lab) {
    if (!lab.shader_work.editors)
        return false;
    const auto& editors = lab.shader_work.editors->by_name;
    return std::any_of(editors.begin(), editors.end(), [](const auto& entry) { return entry.second.modified; });
}

} // namespace clothlab::ui
