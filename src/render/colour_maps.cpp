#include "render/colour_maps.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace clothlab::render {

namespace {

// Control points at equal distances, as RRGGBB one after the other: every fifth of the published 256 colours of
// viridis and inferno (S. van der Walt, N. Smith, 2015, in matplotlib, public domain by CC0) and of cividis
// (J. Nuñez, C. Anderton, R. Renslow, PLOS ONE 13(7), 2018, in matplotlib).
constexpr std::string_view viridis_points =
    "44015446085C471063481769481D6F482475472A7A46307E453781433D844142873F48893D4E8A3A538B38598C355E8D"
    "33638D31688E2E6D8E2C718E2A768E297B8E27808E25848E23898E218E8D20928C1F978B1E9C891FA18821A58524AA83"
    "28AE802EB37C35B7793DBC7446C06F50C46A5AC86465CB5E70CF577CD25089D54895D840A2DA37B0DD2FBDDF26CAE11F"
    "D8E219E5E419F1E51DFDE725";
constexpr std::string_view cividis_points =
    "00224E002656002A5F002D68003070083370163770203A6F273E6E2E416D34456C3A486C3F4C6C444F6C49536C4E566C"
    "535A6D575D6D5C616E60646F656870696B716D6F727272747676767A7A787E7D788381798885788D8878928C78969077"
    "9B9476A09875A59C74AAA073AFA471B5A86FBAAC6DBFB06BC4B468C9B965CFBD62D4C15FDAC65BDFCA57E5CF52EAD34C"
    "F0D846F6DD3FFCE236FEE838";
constexpr std::string_view inferno_points =
    "00000402020C0504170A072210092D160B391E0C45260C512F0A5B380962400A67490B6A510E6C59106E61136E69166E"
    "71196E781C6D801F6C88226A902568982766A02A63A82E5FB0315BB73557BF3952C63D4DCC4248D34743D94D3DDF5337"
    "E45A31E9612BED6925F1711FF47918F78212F98B0BFA9407FB9D07FCA60CFCB014FBBA1FFAC42AF8CD37F6D746F4E156"
    "F2EA69F2F27DF5F992FCFFA4";
// ColorBrewer 2 (C. Brewer, M. Harrower, colorbrewer2.org): the blue half of the 11 colours of RdBu and the orange half
// of those of PuOr. Both are marked safe for colour-blind people and meet in the same grey.
constexpr std::string_view blue_orange_points = "0530612166AC4393C392C5DED1E5F0F7F7F7FEE0B6FDB863E08214B358067F3B08";

int digit(char c) {
    return c <= '9' ? c - '0' : c - 'A' + 10;
}

float channel(std::string_view points, std::size_t point, std::size_t k) {
    const std::size_t at = 6 * point + 2 * k;
    return static_cast<float>(16 * digit(points[at]) + digit(points[at + 1]));
}

/// Linear interpolation of the sRGB values, in which these maps are published.
Image interpolated(std::string_view points) {
    constexpr std::size_t width = 256;
    const std::size_t last = points.size() / 6 - 1;
    Image image{static_cast<int>(width), 1, {}};
    for (std::size_t x = 0; x < width; ++x) {
        const std::size_t point = std::min(x * last / (width - 1), last - 1);
        const float t = static_cast<float>(x * last) / static_cast<float>(width - 1) - static_cast<float>(point);
        for (std::size_t k = 0; k < 3; ++k)
            image.rgba.push_back(static_cast<std::uint8_t>(
                std::lround((1 - t) * channel(points, point, k) + t * channel(points, point + 1, k))));
        image.rgba.push_back(255);
    }
    return image;
}

} // namespace

Image viridis() {
    return interpolated(viridis_points);
}

Image cividis() {
    return interpolated(cividis_points);
}

Image inferno() {
    return interpolated(inferno_points);
}

Image blue_orange() {
    return interpolated(blue_orange_points);
}

} // namespace clothlab::render
