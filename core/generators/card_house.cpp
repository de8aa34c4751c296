// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/portable.h"
#include "core/generators/request.h"
#include "core/math/random.h"

#include <array>

//              /\              two leaning cards make a tent; a card lies from the
//             /  \             top of one to the top of the next, and each carries
//            ------            a tent of the next storey
//            /\  /\  .
//           /  \/  \ .

namespace carom {

GeneratorRow cardHouseGenerator();

namespace cardHouseScene {
namespace {

constexpr double cardLength = 0.09, cardWidth = 0.06, thickness = 0.001; ///< [m]
constexpr double mass = 0.002;                                           ///< [kg]
constexpr double gap = 1e-7;     ///< left where cards touch: what rounding their places needs [m]
constexpr double perMetre = 1e9; ///< places are whole multiples of a nanometre

constexpr std::array<GeneratorOption, 3> options = {{
    jitterOption(0, 0.0005, "how far a storey may be off its place along the cards' edges"),
    {.name = "angle",
     .unit = "degrees",
     .defaultValue = 25,
     .minimum = 5,
     .maximum = 28,
     .help = "by which the cards lean"},
    {.name = "friction",
     .unit = "",
     .defaultValue = 0.7,
     .minimum = 0,
     .maximum = 2,
     .help = "of the cards and of the table"},
}};

std::string generateCardHouse(const GeneratorRequest& request) {
    const GeneratorRow row = cardHouseGenerator();
    const std::int64_t storeys = countOf(row, request);
    const double angle = optionOf(row, request, "angle");
    const double friction = optionOf(row, request, "friction");
    const double jitter = optionOf(row, request, "jitter");
    const double sine = portableSine(angle), cosine = portableCosine(angle);
    const double tent = cardLength * cosine + thickness * sine; // height of a tent
    const double storey = tent + thickness + 2 * gap;           // and of its roof
    const double reach =
        cardLength / 2 * sine + thickness / 2 * cosine + gap; // of a card's middle from the tent's
    const double roof = 2 * (cardLength * sine + 2 * thickness * cosine); // from one tent to the next
    const double top = storey * static_cast<double>(storeys);

    SceneWriter scene =
        sceneFor(row, request, "Card house: " + std::to_string(storeys) + " storeys of leaning cards.",
                 "nothing happens: friction holds it. With `--friction 0.1` it slides apart at once,\n"
                 "and less than tan(angle)/2 can never hold even one tent.");
    scene.camera(rounded(Vec3(0.5 * top, 0.9 * top, 1.5 * top + 0.2), 1e3),
                 rounded(Vec3(0, 0.45 * top, 0), 1e3), 40);
    scene.blankLine();
    scene.wall(Vec3::UnitY(), 0, 0, "green", friction);
    Random random(request.seed);
    for (std::int64_t level = 0; level < storeys; ++level) {
        const double floor = storey * static_cast<double>(level);
        const double aside = random.uniform(-jitter, jitter);
        const std::int64_t tents = storeys - level;
        const double left = -0.5 * roof * static_cast<double>(tents - 1);
        WrittenBody card{.mass = mass, .elastic = 0, .friction = friction};
        for (std::int64_t k = 0; k < tents; ++k)
            for (const double side : {-1.0, 1.0}) {
                const double x = left + roof * static_cast<double>(k) + side * reach;
                card.centre = rounded(Vec3(x, floor + tent / 2 + gap, aside), perMetre);
                card.colour = side < 0 ? "white" : "silver";
                scene.cuboid({thickness, cardLength, cardWidth}, {0, 0, side * angle}, card);
            }
        card.colour = "red";
        for (std::int64_t k = 0; k + 1 < tents; ++k) {
            const double x = left + roof * (static_cast<double>(k) + 0.5);
            card.centre = rounded(Vec3(x, floor + tent + thickness / 2 + 2 * gap, aside), perMetre);
            scene.cuboid({rounded(roof - thickness * cosine, perMetre), thickness, cardWidth}, Vec3::Zero(),
                         card);
        }
    }
    return scene.take();
}

} // namespace
} // namespace cardHouseScene

GeneratorRow cardHouseGenerator() {
    using namespace cardHouseScene;
    return {.name = "card_house",
            .help = "a house of cards of N storeys",
            .defaultN = 3,
            .minimumN = 1,
            .maximumN = 100,
            .options = options,
            .generate = generateCardHouse};
}

} // namespace carom
