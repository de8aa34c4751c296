// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/camera.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

/// One body as the graphics card reads it (resources/shaders/instance.glsl), 64 bytes.
struct Instance {
    float position[3];    ///< [m]
    float pattern;        ///< strength of the markings that show spin, 0..1
    float orientation[4]; ///< quaternion x, y, z, w
    float halfSize[3];    ///< [m]; a sphere's radius, a cylinder's radius, half height, radius
    float unused;
    float colour[4]; ///< as displayed, 0..1; alpha unused
};
static_assert(sizeof(Instance) == 64);

/// A part of an array of instances.
struct InstanceRange {
    int first = 0;
    int count = 0;
};

/// How many corners stand for a circle: as many as keep it true to a quarter of a pixel.
enum class Detail : std::size_t { Coarse, Medium, Fine };
inline constexpr std::array detailSegments = {16, 36, 96};
inline constexpr std::size_t detailCount = detailSegments.size();

/// All bounded bodies of a scene, kind by kind, rewritten for every picture.
class InstanceTable {
  public:
    void build(const Scene& scene);
    /// Writes the poses for a picture of `size` [device px]. A body whose orientation is not the one it
    /// started with is marked as spinning from then on.
    void place(std::span<const Pose> poses, const Camera& camera, const PictureSize& size,
               const Camera& light);

    std::span<const Instance> all() const { return m_instances; }
    /// Back to front: their edges are blended.
    InstanceRange spheres() const { return m_spheres; }
    InstanceRange cylinders(Detail detail) const { return m_byDetail[static_cast<std::size_t>(detail)]; }
    InstanceRange cuboids() const { return m_cuboids; }
    /// A sphere carries the pattern that shows spin.
    bool anySpins() const { return m_anySpins; }
    /// Where a body stands in all(); -1 for walls. Changes with place().
    int indexOf(BodyIndex body) const;
    /// The box of all bounded bodies at the last place(); around the origin where there are none.
    const Aabb& bounds() const { return m_bounds; }
    /// The same in the light's coordinates (right, up, backward of place()'s `light`).
    const Aabb& lightBounds() const { return m_lightBounds; }

  private:
    struct Source {
        BodyIndex body = noBody;
        Instance instance;
        Quat start;        ///< orientation at time 0
        double radius = 0; ///< of the ball around it [m]
        double depth = 0;  ///< in front of the eye [m]
        Detail detail = Detail::Fine;
    };

    std::span<Source> part(InstanceRange range);
    void orderSpheres();
    void orderCylinders(const Camera& camera, double pixel);

    std::vector<Source> m_sources;
    std::vector<Instance> m_instances;
    std::vector<int> m_indexOf;
    InstanceRange m_spheres, m_cylinders, m_cuboids;
    std::array<InstanceRange, detailCount> m_byDetail;
    Aabb m_bounds, m_lightBounds;
    bool m_anySpins = false;
};

/// The box of all bounded bodies in these poses; a unit box around the origin where there are none.
Aabb boundsOf(const Scene& scene, std::span<const Pose> poses);

} // namespace carom
