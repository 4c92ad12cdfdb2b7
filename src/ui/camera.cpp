#include "ui/camera.h"

#include <algorithm>
#include <cmath>

#include "scene/camera.h"
#include "scene/io.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace clothlab::ui {
namespace {

constexpr double flight_seconds = 0.25;

struct SideKey {
    scene::Side side;
    const char* name; ///< as menus show it
    ImGuiKeyChord key, keypad;
};
constexpr SideKey side_keys[] = {
    {scene::Side::front, "1", ImGuiKey_1, ImGuiKey_Keypad1},
    {scene::Side::back, "Shift+1", ImGuiMod_Shift | ImGuiKey_1, ImGuiMod_Shift | ImGuiKey_Keypad1},
    {scene::Side::right, "3", ImGuiKey_3, ImGuiKey_Keypad3},
    {scene::Side::left, "Shift+3", ImGuiMod_Shift | ImGuiKey_3, ImGuiMod_Shift | ImGuiKey_Keypad3},
    {scene::Side::top, "7", ImGuiKey_7, ImGuiKey_Keypad7},
    {scene::Side::three_quarter, "9", ImGuiKey_9, ImGuiKey_Keypad9},
};

void fit_scene(Lab& lab) {
    fly(lab, scene::fitted(heading(lab), scene::start_box(lab.scene.simulation)));
}

void fit_cloth(Lab& lab) {
    if (lab.snapshot)
        fly(lab, scene::fitted(heading(lab), lab.snapshot->positions));
}

void switch_projection(Lab& lab) {
    finish_flight(lab);
    scene::Camera camera = scene::camera_of(lab.scene);
    const bool perspective = camera.projection == scene::Projection::perspective;
    camera.projection = perspective ? scene::Projection::orthographic : scene::Projection::perspective;
    lab.scene.camera = camera;
}

bool pressed(ImGuiKeyChord key) {
    return ImGui::Shortcut(key, ImGuiInputFlags_RouteGlobal);
}

void menu(Lab& lab) {
    const scene::Camera camera = heading(lab);
    for (const SideKey& k : side_keys) {
        const scene::Camera there = scene::seen_from(camera, k.side);
        if (ImGui::MenuItem(scene::sides()[static_cast<std::size_t>(k.side)].name.data(), k.name, camera == there))
            fly(lab, there);
    }
    const scene::Camera scenes_own = scene::camera_of(lab.loaded);
    if (ImGui::MenuItem("Scene's own view", "0", camera == scenes_own))
        fly(lab, scenes_own);
    tooltip("Back to the camera that the scene was loaded with");
    ImGui::Separator();
    if (ImGui::MenuItem("Fit the scene", "F"))
        fit_scene(lab);
    tooltip("Nearer or further away until the whole scene as it starts is seen");
    if (ImGui::MenuItem("Fit the cloth", "Shift+F", false, lab.snapshot != nullptr))
        fit_cloth(lab);
    tooltip("Nearer or further away until the cloth as it is now fills the picture");
    ImGui::Separator();
    if (ImGui::MenuItem("Orthographic", "5", camera.projection == scene::Projection::orthographic))
        switch_projection(lab);
    tooltip("Sizes can be compared and parallel lines stay parallel; nothing is smaller for being further away");
    if (begin_fields("camera")) {
        field_row(lab, "camera.fov");
        end_fields();
    }
    ImGui::Separator();
    if (ImGui::MenuItem(ICON_FA_COPY "  Copy camera", "Ctrl+Shift+C"))
        copy_camera(lab);
    tooltip("As JSON, for a scene's \"camera\" or a file that `clothlab render --camera` reads");
    if (ImGui::MenuItem(ICON_FA_PASTE "  Paste camera", "Ctrl+Shift+V"))
        paste_camera(lab);
    tooltip("From such a text on the clipboard");
}

} // namespace

scene::Camera heading(const Lab& lab) {
    return lab.flight ? lab.flight->to : scene::camera_of(lab.scene);
}

void fly(Lab& lab, const scene::Camera& to) {
    const scene::Camera from = scene::camera_of(lab.scene);
    lab.flight.reset();
    if (from != to)
        lab.flight = CameraFlight{from, to, from, 0};
}

void advance_flight(Lab& lab, double seconds) {
    if (!lab.flight)
        return;
    CameraFlight& flight = *lab.flight;
    if (scene::camera_of(lab.scene) != flight.at)
        return lab.flight.reset();
    // A lab that was at rest or slow still shows the way.
    flight.share = std::min(1.0, flight.share + std::min(seconds, 1.0 / 20) / flight_seconds);
    const double s = flight.share, eased = s * s * (3 - 2 * s);
    lab.scene.camera = flight.at = scene::between(flight.from, flight.to, eased);
    if (s == 1)
        lab.flight.reset();
}

void finish_flight(Lab& lab) {
    if (lab.flight && scene::camera_of(lab.scene) == lab.flight->at)
        lab.scene.camera = lab.flight->to;
    lab.flight.reset();
}

void move_camera(Lab& lab, float shorter_side) {
    const ImGuiIO& io = ImGui::GetIO();
    scene::Camera camera = scene::camera_of(lab.scene);
    const scene::Camera before = camera;
    if (being_dragged()) {
        const double dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left) && !io.KeyShift) {
            camera.yaw = std::remainder(camera.yaw - 0.35 * dx, 360.0);
            camera.pitch = std::clamp(camera.pitch + 0.35 * dy, -89.0, 89.0);
        } else {
            // The point under the mouse follows it: the shorter side is what the field of view spans at the target.
            const double per_pixel = scene::height_at_target(camera) / static_cast<double>(shorter_side);
            const scene::CameraFrame f = scene::frame(camera);
            const double r = -dx * per_pixel, u = dy * per_pixel;
            camera.target = {camera.target.x + r * f.right.x + u * f.up.x, camera.target.y + r * f.right.y + u * f.up.y,
                             camera.target.z + r * f.right.z + u * f.up.z};
        }
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0)
        camera.distance = std::clamp(camera.distance * std::pow(0.88, static_cast<double>(io.MouseWheel)),
                                     scene::min_distance, scene::max_distance);
    if (camera != before)
        lab.scene.camera = camera;
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        fit_scene(lab);
}

float draw_camera_bar(Lab& lab, ImVec2 corner, float width) {
    const ImGuiStyle& style = ImGui::GetStyle();
    const float side = ImGui::GetFrameHeight(), gap = style.ItemInnerSpacing.x / 2;
    const float bar = 3 * side + 2 * gap;
    if (width < bar + 2 * style.WindowPadding.x)
        return 0;
    const bool orthographic = heading(lab).projection == scene::Projection::orthographic;
    ImVec4 under = style.Colors[ImGuiCol_Button];
    under.w *= 0.75f; // the picture shows through
    ImGui::PushStyleColor(ImGuiCol_Button, under);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, style.FramePadding.y}); // icons in the middle of their buttons
    ImGui::SetCursorScreenPos({corner.x + width - bar - style.WindowPadding.x, corner.y + style.WindowPadding.y});
    if (icon_button(ICON_FA_VIDEO, "##views", "Camera: sides to look from, field of view, copy and paste"))
        ImGui::OpenPopup("views");
    ImGui::SameLine(0, gap);
    if (icon_button(ICON_FA_EXPAND, "##fit", "Show the whole scene (F). Shift+F: the cloth as it is now"))
        fit_scene(lab);
    ImGui::SameLine(0, gap);
    if (icon_button(orthographic ? ICON_FA_SQUARE : ICON_FA_CUBE, "##projection",
                    orthographic ? "Orthographic; click for perspective (5)"
                                 : "Perspective; click for orthographic (5)"))
        switch_projection(lab);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    if (ImGui::BeginPopup("views")) {
        menu(lab);
        ImGui::EndPopup();
    }
    return side + style.WindowPadding.y;
}

void camera_keys(Lab& lab) {
    for (const SideKey& k : side_keys)
        if (pressed(k.key) || pressed(k.keypad))
            fly(lab, scene::seen_from(heading(lab), k.side));
    if (pressed(ImGuiKey_0) || pressed(ImGuiKey_Keypad0))
        fly(lab, scene::camera_of(lab.loaded));
    if (pressed(ImGuiKey_5) || pressed(ImGuiKey_Keypad5))
        switch_projection(lab);
    if (pressed(ImGuiKey_F))
        fit_scene(lab);
    if (pressed(ImGuiMod_Shift | ImGuiKey_F))
        fit_cloth(lab);
    if (pressed(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_C))
        copy_camera(lab);
    if (pressed(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_V))
        paste_camera(lab);
}

void copy_camera(const Lab& lab) {
    ImGui::SetClipboardText(scene::write_camera(heading(lab)).c_str());
}

void paste_camera(Lab& lab) {
    const char* text = ImGui::GetClipboardText();
    try {
        if (text == nullptr || *text == '\0')
            throw scene::SceneError("The clipboard holds no text to take a camera from");
        fly(lab, scene::read_camera(text, "The camera on the clipboard"));
    } catch (const scene::SceneError& e) {
        lab.messages.push_back({true, e.what()});
    }
}

} // namespace clothlab::ui
