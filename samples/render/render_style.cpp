#include "render_style.h"

#include <array>

namespace swept::style {

namespace {

constexpr Color kStatic = rgb(0xCDD1D6);
constexpr Color kKinematic = rgb(0x6FC2A9);
constexpr Color kBullet = rgb(0xE5554F);
constexpr Color kAsleep = rgb(0x98A0AB);
constexpr std::array<Color, 6> kPalette{rgb(0x82B1DE), rgb(0xF2B67C), rgb(0xB7A3DC),
                                        rgb(0xEBD17F), rgb(0xE6A6BB), rgb(0x8FCBE0)};

BodyStyle edged(Color fill) { return {fill, mix(fill, rgb(0x20262E), 0.45)}; }

}  // namespace

Color paletteColor(std::size_t index) { return kPalette[index % kPalette.size()]; }

BodyStyle bodyStyle(SceneBodyType type, bool bullet, bool awake, std::size_t index) {
    switch (type) {
        case SceneBodyType::fixed:
            return edged(kStatic);
        case SceneBodyType::kinematic:
            return edged(kKinematic);
        case SceneBodyType::dynamic:
            break;
    }
    const Color fill = bullet ? kBullet : paletteColor(index);
    return edged(awake ? fill : mix(fill, kAsleep, 0.72));
}

}  // namespace swept::style
