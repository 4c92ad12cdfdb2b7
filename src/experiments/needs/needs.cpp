#include "experiments/needs/needs.h"

#include <algorithm>
#include <string_view>

#include "experiments/needs/findings.h"
#include "experiments/needs/search.h"
#include "scene/error.h"
#include "scene/fields.h"

namespace clothlab::experiments::needs {
namespace {

void check_kept(const Config& config) {
    std::vector<std::string_view> known{"colliders"};
    for (const scene::Field& field : scene::fields())
        for (const std::string_view name : {field.key, field.section()})
            if (std::find(known.begin(), known.end(), name) == known.end())
                known.push_back(name);
    for (const std::string& key : config.kept) {
        if (std::find(known.begin(), known.end(), key) != known.end())
            continue;
        const auto meant = scene::nearest(key, known);
        throw scene::SceneError(
            "--keep " + key + ": no parameter and no section of that name" +
            (meant ? "; did you mean " + std::string(*meant) + "?" : std::string("; see `clothlab list parameters`")));
    }
}

} // namespace

Result run_needs(const Config& config, const Progress& progress) {
    check_kept(config);
    if (!(config.tolerance > 0))
        throw Refusal("the tolerance has to be a number above 0");
    const Found found = search(config, progress);
    return {findings_of(config, found), recommended_scene(config, found)};
}

} // namespace clothlab::experiments::needs
