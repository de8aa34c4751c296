// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/aabb.h"
#include "core/math/pose.h"
#include "core/shapes/shape.h"

#include <cstdint>
#include <vector>

namespace carom {

/// Fine lines are a pixel wide and go behind bodies, where they show faintly; wide ones are wider; marks are
/// as wide, and in front of everything.
enum class LineKind : std::uint8_t { Fine, Wide, Mark };

/// Two in a row make a line.
struct LineVertex {
    float position[3]; ///< [m]
    float colour[3];   ///< as displayed, 0..1
    LineKind kind = LineKind::Fine;
};

/// Draws with lines in world coordinates, by appending to what is there.
class LinePen {
  public:
    explicit LinePen(std::vector<LineVertex>& lines) : m_lines(lines) {}

    /// Of what is drawn from now on.
    void setKind(LineKind kind) { m_kind = kind; }
    void line(const Vec3& from, const Vec3& to, const Vec3& colour);
    void arrow(const Vec3& from, const Vec3& along, const Vec3& colour);
    void box(const Aabb& box, const Vec3& colour);
    /// Three lines that cross, `size` long [m], along the axes.
    void star(const Vec3& centre, double size, const Vec3& colour);
    /// A body as wire; nothing for walls.
    void outline(const Shape& shape, const Pose& worldFromBody, const Vec3& colour);

  private:
    void circle(const Pose& worldFromBody, const Vec3& centre, const Mat3& axes, const Vec3& colour);

    std::vector<LineVertex>& m_lines;
    LineKind m_kind = LineKind::Fine;
};

} // namespace carom
