// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/text.h"
#include "core/math/types.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Writes the scene language, in the canonical layout (a test holds it to the formatter). Numbers are the
// shortest that read back exactly (std::to_chars), so equal values are equal bytes on every machine.

namespace carom {

/// What every body takes; what equals the language's default is left out of the text.
struct WrittenBody {
    std::string label{};
    Vec3 centre = Vec3::Zero();   ///< [m]
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
    double mass = 1;              ///< [kg]
    double elastic = 1;
    double friction = 0;
    bool fixed = false;                ///< then it needs no mass
    std::string_view colour = "white"; ///< one of the basic colour names, or three components
};

/// A spring between two labelled bodies, or a body and `world`.
struct WrittenSpring {
    std::string_view from = "world";
    std::string_view to{};
    Vec3 fromAt = Vec3::Zero();     ///< [m], in the world for `world`, else in the body
    double stiffness = 0;           ///< [N/m]
    double damping = 0;             ///< [N s/m]
    std::optional<double> length{}; ///< at rest [m]; absent: that of the start
};

/// Colours that tell neighbours apart.
inline constexpr std::array<std::string_view, 6> brightColours = {"red",  "yellow", "lime",
                                                                  "aqua", "blue",   "fuchsia"};

class SceneWriter {
  public:
    /// From now on a line a parameter, for declarations of which only some would fit one line.
    void spreadOut() { m_spreadOut = true; }
    /// One comment line for each line of `text`.
    void comment(std::string_view text);
    void blankLine() { m_text += '\n'; }
    void gravity(const Vec3& acceleration);
    void substeps(int count); ///< a `simulation` declaration
    void camera(const Vec3& position, const Vec3& target, double fieldOfView);
    void wall(const Vec3& normal, double toOrigin, double elastic, std::string_view colour,
              double friction = 0);
    /// A floor at height 0 and four upright walls around it, `half` [m] from the middle.
    void openBox(double half, double elastic, double friction);
    void sphere(double radius, const WrittenBody& body);
    void cylinder(double radius, double height, const Vec3& axis, const Vec3& spin, const WrittenBody& body);

    /// `size` are the edges [m], `rotation` is axis × angle in degrees.
    void cuboid(const Vec3& size, const Vec3& rotation, const WrittenBody& body);
    void spring(const WrittenSpring& spring);

    std::string take() { return std::move(m_text); }

  private:
    void open(std::string_view type, std::string_view label = {});
    void parameter(std::string_view name, double value);
    void parameter(std::string_view name, const Vec3& value);
    void parameter(std::string_view name, std::string_view word);
    void common(const WrittenBody& body);
    void close();

    std::string m_text;
    std::string m_head;                    ///< of the declaration being written: type and label
    std::vector<std::string> m_parameters; ///< its parameters, "radius 0.1"
    bool m_spreadOut = false;
};

/// The nearest multiple of 1/perUnit: what random draws and results are rounded to, so that texts stay
/// readable. Never -0.
double rounded(double value, double perUnit);
Vec3 rounded(const Vec3& value, double perUnit);
inline double toMillionths(double value) { return rounded(value, 1e6); }
inline Vec3 toMillionths(const Vec3& value) { return rounded(value, 1e6); }

} // namespace carom
