// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/varied_scene.h"

#include "core/math/random.h"
#include "core/study/cases/scene_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace carom::test {
namespace {

class VariedScene {
  public:
    explicit VariedScene(std::uint64_t seed, int mostBodies) : m_random(seed) {
        m_text = carom::text("// varied scene, seed ", std::to_string(seed), ", at most ", mostBodies,
                             " bodies\n");
        m_count = static_cast<int>(std::lround(between(1, mostBodies)));
        drawKind();
        placeWalls();
        for (int i = 0; i < m_count; ++i) placeBody(i);
        if (m_isBox) wallAt(-Vec3::UnitY(), m_top);
        for (int i = 0; i < m_springs; ++i) addSpring();
    }

    const std::string& text() const { return m_text; }

  private:
    struct Plane {
        Vec3 normal;
        double offset; ///< of the solid's surface: normal · x = −offset [m]
    };
    struct Placed {
        Vec3 centre;
        double radius; ///< of the ball that holds it [m]
        double mass;   ///< [kg], 0 where it is fixed
    };
    enum class Shape { Sphere, Cylinder, Cuboid };

    /// Equally likely on a logarithmic scale.
    double between(double low, double high) {
        return low * std::exp(m_random.uniform() * std::log(high / low));
    }
    bool oneIn(std::uint64_t n) { return m_random.below(n) == 0; }
    double oneOf(std::span<const double> values) { return values[m_random.below(values.size())]; }
    Vec3 direction() {
        const double x = m_random.gaussian(), y = m_random.gaussian();
        return Vec3(x, y, m_random.gaussian()).normalized();
    }

    /// What all bodies of the scene have in common.
    void drawKind() {
        m_size = between(0.02, 1);
        m_sizeRatio = oneIn(2) ? 1 : between(1, 6);
        m_massRatio = oneIn(2) ? 1 : between(1, 1000);
        m_thinness = oneIn(3) ? between(2, 50) : 1;
        for (const Shape shape : {Shape::Sphere, Shape::Cylinder, Shape::Cuboid})
            if (!oneIn(3)) m_shapes.push_back(shape);
        if (m_shapes.empty()) m_shapes.push_back(Shape::Cuboid);
        m_elastic = oneIn(3) ? -1 : oneOf(elastics);
        m_friction = oneIn(3) ? -1 : oneOf(frictions);
        m_rolling = oneIn(5) ? 0.01 * m_size : 0;
        m_speed = oneIn(2) ? 0 : between(0.1, 10);
        m_hasFixed = oneIn(8);
        m_springs = oneIn(4) ? 1 + m_count / 5 : 0;
        m_container = m_random.below(6);
        m_isBox = m_container == 5;
        if (m_isBox) m_text += weightless();
        const double perBody = 2.5 * m_size * std::max(1.0, std::cbrt(m_sizeRatio));
        m_half = std::max({perBody * std::cbrt(m_count) / 2, 1.2 * m_size * m_sizeRatio});
    }

    /// `elastic` and `friction` as the scene has them: one value for all, or each its own.
    std::string surface() {
        const double elastic = m_elastic < 0 ? m_random.uniform() : m_elastic;
        const double friction = m_friction < 0 ? m_random.uniform(0, 1.5) : m_friction;
        std::string words = carom::text("  elastic ", elastic, "  friction ", friction);
        if (m_rolling > 0) words += carom::text("  rolling ", m_rolling);
        return words;
    }

    void wallAt(const Vec3& normal, double offset) {
        m_planes.push_back({normal.normalized(), offset});
        m_text +=
            carom::text("wall { normal ", m_planes.back().normal, "  toOrig ", offset, surface(), " }\n");
    }
    void placeWalls() {
        const Vec3 up = Vec3::UnitY();
        constexpr std::array<double, 3> tilts = {0, 0, 0.3};
        wallAt(up + oneOf(tilts) * Vec3(m_random.uniform(-1, 1), 0, m_random.uniform(-1, 1)), 0);
        if (m_container == 2) { // a corner: two more walls, leaning outwards
            wallAt(Vec3(1, m_random.uniform(0, 1), 0.2), m_half);
            wallAt(Vec3(0.2, m_random.uniform(0, 1), 1), m_half);
        }
        if (m_container == 3) { // a chimney between two walls
            m_half = std::max(1.1 * m_size * m_sizeRatio, m_half / 3);
            wallAt(Vec3::UnitX(), m_half);
            wallAt(-Vec3::UnitX(), m_half);
        }
        const double lean = m_container == 4 ? m_random.uniform(0.3, 2) : 0; // a funnel, or upright
        if (m_container == 1 || m_container >= 4)
            for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
                wallAt(side + lean * up, m_half);
    }

    /// A free place for a ball; the search goes higher until there is one.
    Vec3 freePlace(double radius) {
        for (double height = 2 * m_half;; height += 0.02 * m_half) {
            const double x = m_random.uniform(-m_half, m_half), z = m_random.uniform(-m_half, m_half);
            const Vec3 centre(x, m_random.uniform(0, height), z);
            const double clear = 1.001 * radius;
            const auto isBefore = [&](const Plane& plane) {
                return plane.normal.dot(centre) + plane.offset > clear;
            };
            const auto isApart = [&](const Placed& other) {
                return (other.centre - centre).norm() > clear + other.radius;
            };
            if (std::ranges::all_of(m_planes, isBefore) && std::ranges::all_of(m_bodies, isApart))
                return centre;
        }
    }

    void placeBody(int number) {
        const double size = m_size * between(1, m_sizeRatio) / 2; // half of it [m]
        const double thin = between(1, m_thinness);
        const Shape shape = m_shapes[m_random.below(m_shapes.size())];
        std::string words;
        double radius = size, volume = 4.0 / 3 * std::numbers::pi * size * size * size;
        if (shape == Shape::Sphere) words = carom::text("sphere b", number, " { radius ", size);
        if (shape == Shape::Cylinder) {
            const bool isDisc = oneIn(2);
            const double around = isDisc ? size : size / thin, along = isDisc ? size / thin : size;
            words = carom::text("cylinder b", number, " { radius ", around, "  height ", 2 * along, "  axis ",
                                direction());
            radius = std::hypot(around, along);
            volume = 2 * std::numbers::pi * around * around * along;
        }
        if (shape == Shape::Cuboid) {
            const double other = between(1, m_thinness); // a plate where this is near 1, else a stick
            const Vec3 edges =
                2 * size * Vec3(1, 1 / thin, m_thinness > 1 ? 1 / other : m_random.uniform(0.5, 1));
            words = carom::text("cuboid b", number, " { size ", edges, "  rotation ",
                                m_random.uniform(0, 180) * direction());
            radius = edges.norm() / 2;
            volume = edges.prod();
        }
        const Vec3 centre = freePlace(radius);
        m_top = std::max(m_top, centre.y() + 1.1 * radius);
        const bool isFixed = m_hasFixed && oneIn(8);
        const double mass = isFixed ? 0 : 1000 * volume * between(1, m_massRatio);
        words += carom::text("  centre ", centre, isFixed ? "  fixed yes" : carom::text("  mass ", mass));
        if (m_speed > 0 && !isFixed) {
            words += carom::text("  vel ", m_speed * m_random.uniform() * direction());
            if (oneIn(2)) words += carom::text("  angvel ", m_random.uniform(0, 10) * direction());
        }
        m_text += words + surface() + " }\n";
        m_bodies.push_back({centre, radius, mass});
    }

    /// Between two bodies or a body and the world, at their centres or off them; with a frequency of its own.
    void addSpring() {
        const std::size_t a = m_random.below(m_bodies.size()), b = m_random.below(m_bodies.size());
        const Placed &one = m_bodies[a], &two = m_bodies[b];
        if (one.mass == 0) return;
        const bool toWorld = a == b || two.mass == 0;
        const double frequency = 2 * std::numbers::pi * between(0.3, 60);
        const double mass = toWorld ? one.mass : std::min(one.mass, two.mass);
        const Vec3 anchor = one.centre + Vec3(0, 3 * m_size, 0);
        const double distance = toWorld ? 3 * m_size : (one.centre - two.centre).norm();
        m_text += carom::text("spring { from ", toWorld ? std::string("world") : "b" + std::to_string(b),
                              "  to b", static_cast<int>(a));
        if (toWorld) m_text += carom::text("  fromAt ", anchor);
        if (oneIn(3)) m_text += carom::text("  toAt ", 0.5 * one.radius * direction());
        m_text += carom::text("  stiffness ", mass * frequency * frequency);
        if (oneIn(2)) m_text += carom::text("  damping ", m_random.uniform(0, 0.5) * mass * frequency);
        m_text += carom::text("  length ", m_random.uniform(0.5, 1.5) * distance, " }\n");
    }

    static constexpr std::array<double, 6> elastics = {0, 0, 0.2, 0.5, 0.8, 1};
    static constexpr std::array<double, 6> frictions = {0, 0.1, 0.3, 0.5, 0.8, 1};

    Random m_random;
    std::string m_text;
    int m_count = 1, m_springs = 0;
    double m_size = 1; ///< of the smallest bodies [m]
    double m_sizeRatio = 1, m_massRatio = 1, m_thinness = 1;
    std::vector<Shape> m_shapes;
    double m_elastic = 0, m_friction = 0; ///< negative: each body and wall its own
    double m_rolling = 0;                 ///< [m]
    double m_speed = 0;                   ///< largest at the start [m/s]
    bool m_hasFixed = false, m_isBox = false;
    std::uint64_t m_container = 0;
    double m_half = 1; ///< half the width that bodies start in [m]
    double m_top = 0;  ///< no body starts higher [m]
    std::vector<Plane> m_planes;
    std::vector<Placed> m_bodies;
};

} // namespace

std::string variedScene(std::uint64_t seed, int mostBodies) { return VariedScene(seed, mostBodies).text(); }

} // namespace carom::test
