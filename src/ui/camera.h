// The camera in the lab: the mouse and the keys that move it, its menu in the viewport's corner, and the way it takes.
#pragma once

#include <imgui.h>

#include "ui/lab.h"

namespace clothlab::ui {

/// Sends the camera to another one, along a smooth way of a quarter of a second. Anything else that moves the camera
/// ends the flight where it is.
void fly(Lab& lab, const scene::Camera& to);
/// Where the camera is going to be.
scene::Camera heading(const Lab& lab);
/// Moves a flying camera on; `seconds` since the last time.
void advance_flight(Lab& lab, double seconds);
/// Puts a flying camera to where it is going.
void finish_flight(Lab& lab);

/// The mouse on the last item, the picture, moves the camera; `shorter_side` of the picture in the unit of the mouse.
void move_camera(Lab& lab, float shorter_side);
/// The bar in the upper right corner of a picture, and its height.
float draw_camera_bar(Lab& lab, ImVec2 corner, float width);
/// Keys of the whole window that concern the camera: see shortcuts().
void camera_keys(Lab& lab);

/// The camera as JSON on the clipboard, as `render --camera` reads it.
void copy_camera(const Lab& lab);
/// The camera from such a text on the clipboard. One that is wrong changes nothing, and the lab says why.
void paste_camera(Lab& lab);

} // namespace clothlab::ui
