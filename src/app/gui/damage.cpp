#include "app/gui/damage.h"

#include <glad/gl.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

namespace clothlab::app {
namespace {

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
    return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

PixelRect hull(const PixelRect& a, const PixelRect& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

bool empty(const PixelRect& r) {
    return r.x0 >= r.x1 || r.y0 >= r.y1;
}

long area(const PixelRect& r) {
    return empty(r) ? 0 : static_cast<long>(r.x1 - r.x0) * (r.y1 - r.y0);
}

/// Of a clip rectangle of ImGui's: whole pixels, none left out.
PixelRect pixels(const ImVec4& clip, const ImDrawData& data) {
    const auto down = [](float at, float origin, float scale) {
        return static_cast<int>(std::floor((at - origin) * scale));
    };
    const auto up = [](float at, float origin, float scale) {
        return static_cast<int>(std::ceil((at - origin) * scale));
    };
    const ImVec2 &origin = data.DisplayPos, &scale = data.FramebufferScale;
    return {down(clip.x, origin.x, scale.x), down(clip.y, origin.y, scale.y), up(clip.z, origin.x, scale.x),
            up(clip.w, origin.y, scale.y)};
}

PixelRect whole(const ImDrawData& data) {
    const ImVec2 end{data.DisplayPos.x + data.DisplaySize.x, data.DisplayPos.y + data.DisplaySize.y};
    return pixels({data.DisplayPos.x, data.DisplayPos.y, end.x, end.y}, data);
}

template <class T>
void mix(std::uint64_t& hash, const T* values, int count) {
    const std::string_view bytes(reinterpret_cast<const char*>(values), sizeof(T) * static_cast<std::size_t>(count));
    hash = (hash ^ std::hash<std::string_view>{}(bytes)) * 0x9e3779b97f4a7c15u;
}

std::uint64_t looks(const ImDrawList& list) {
    std::uint64_t hash = 0;
    mix(hash, list.VtxBuffer.Data, list.VtxBuffer.Size);
    mix(hash, list.IdxBuffer.Data, list.IdxBuffer.Size);
    for (const ImDrawCmd& command : list.CmdBuffer) {
        mix(hash, &command.ClipRect, 1);
        const unsigned numbers[] = {command.VtxOffset, command.IdxOffset, command.ElemCount};
        mix(hash, numbers, 3);
        mix(hash, &command.TexRef._TexData, 1);
        mix(hash, &command.TexRef._TexID, 1);
    }
    return hash;
}

/// Where a list draws: within the vertices' hull and its commands' clip rectangles.
PixelRect place(const ImDrawList& list, const ImDrawData& data) {
    PixelRect clips;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        const PixelRect clip = pixels(command.ClipRect, data);
        if (command.ElemCount > 0 && !empty(clip))
            clips = empty(clips) ? clip : hull(clips, clip);
    }
    if (list.VtxBuffer.empty())
        return {};
    ImVec4 box{list.VtxBuffer[0].pos.x, list.VtxBuffer[0].pos.y, list.VtxBuffer[0].pos.x, list.VtxBuffer[0].pos.y};
    for (const ImDrawVert& v : list.VtxBuffer)
        box = {std::min(box.x, v.pos.x), std::min(box.y, v.pos.y), std::max(box.z, v.pos.x), std::max(box.w, v.pos.y)};
    return intersection(intersection(clips, pixels(box, data)), whole(data));
}

bool shows(const ImDrawList& list, ImTextureID texture) {
    return texture != 0 && std::any_of(list.CmdBuffer.begin(), list.CmdBuffer.end(), [&](const ImDrawCmd& command) {
               return command.TexRef._TexData == nullptr && command.TexRef._TexID == texture;
           });
}

/// Rectangles are drawn one by one: those that are hardly larger as one become one.
void add(std::vector<PixelRect>& parts, PixelRect part) {
    if (empty(part))
        return;
    for (std::size_t i = 0; i < parts.size();) {
        const PixelRect both = hull(parts[i], part);
        if (area(both) > (area(parts[i]) + area(part)) * 5 / 4) {
            ++i;
            continue;
        }
        part = both;
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(i));
        i = 0;
    }
    parts.push_back(part);
}

} // namespace

std::vector<PixelRect> Damage::update(const ImDrawData& data, ImTextureID new_contents) {
    std::vector<PixelRect> parts;
    const bool all = lists_.empty();
    std::unordered_map<std::string, List> lists;
    std::uint64_t order = 0;
    for (const ImDrawList* list : data.CmdLists) {
        std::string name = list->_OwnerName != nullptr ? list->_OwnerName : "";
        while (lists.contains(name))
            name += '#';
        mix(order, name.data(), static_cast<int>(name.size()));
        const List now{looks(*list), order, place(*list, data)};
        const auto before = lists_.find(name);
        const bool changed = before == lists_.end() || before->second != now;
        if (changed || shows(*list, new_contents))
            add(parts, now.at);
        if (changed && before != lists_.end())
            add(parts, before->second.at);
        if (before != lists_.end())
            lists_.erase(before);
        lists.emplace(std::move(name), now);
    }
    for (const auto& [name, gone] : lists_)
        add(parts, gone.at);
    lists_ = std::move(lists);
    if (all)
        parts = {whole(data)};
    return parts;
}

void draw_part(ImDrawData& data, const PixelRect& part) {
    std::vector<ImVec4> clips;
    ImDrawData drawn = data;
    drawn.CmdLists.clear();
    const auto x = [&](int at) { return static_cast<float>(at) / data.FramebufferScale.x + data.DisplayPos.x; };
    const auto y = [&](int at) { return static_cast<float>(at) / data.FramebufferScale.y + data.DisplayPos.y; };
    for (ImDrawList* list : data.CmdLists) {
        bool any = false;
        for (ImDrawCmd& command : list->CmdBuffer) {
            ImVec4& clip = command.ClipRect;
            clips.push_back(clip);
            clip = {std::max(clip.x, x(part.x0)), std::max(clip.y, y(part.y0)), std::min(clip.z, x(part.x1)),
                    std::min(clip.w, y(part.y1))};
            any = any || (clip.x < clip.z && clip.y < clip.w);
        }
        if (any)
            drawn.CmdLists.push_back(list);
    }
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x0, static_cast<int>(std::lround(data.DisplaySize.y * data.FramebufferScale.y)) - part.y1,
              part.x1 - part.x0, part.y1 - part.y0);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
    ImGui_ImplOpenGL3_RenderDrawData(&drawn);
    auto clip = clips.begin();
    for (ImDrawList* list : data.CmdLists)
        for (ImDrawCmd& command : list->CmdBuffer)
            command.ClipRect = *clip++;
}

} // namespace clothlab::app
