// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/broadphase.h"

#include "core/broadphase/all_pairs.h"
#include "core/broadphase/bounding_tree.h"
#include "core/broadphase/single_axis_sweep.h"
#include "core/broadphase/sweep_and_sort.h"
#include "core/broadphase/uniform_grid.h"

#include "core/base/catalogue.h"

namespace carom {
namespace {

template<class Algorithm>
std::unique_ptr<Broadphase> create() {
    return std::make_unique<Algorithm>();
}

constexpr BroadphaseRow rows[] = {
    {"all_pairs", "All pairs", "O(n^2) a frame, whatever happens",
     "S. Stokes, Collision Detection in the Simulation of Rigid Body Motion, 2005, section 2.3.2",
     create<AllPairs>},
    {"sweep_and_sort", "Sweep and sort", "O(n + exchanges) a frame, O(n log n) the first",
     "D. Baraff, Dynamic Simulation of Non-Penetrating Rigid Bodies, 1992", create<SweepAndSort>},
    {"single_axis_sweep", "Single-axis sweep", "O(n log n + n^(5/3)) a frame in a gas, O(n) in a line",
     "C. Ericson, Real-Time Collision Detection, 2005, section 7.5.2", create<SingleAxisSweep>},
    {"uniform_grid", "Uniform grid", "O(n + pairs) a frame",
     "M. Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003",
     create<UniformGrid>},
    {"bounding_tree", "Bounding tree", "O(n log n + pairs) a frame of motion, O(n + pairs) at rest",
     "G. van den Bergen, Efficient Collision Detection of Complex Deformable Models using AABB Trees, 1997",
     create<BoundingTree>},
};

} // namespace

std::span<const BroadphaseRow> broadphases() { return rows; }

const BroadphaseRow* findBroadphase(std::string_view name) { return findByName(broadphases(), name); }

} // namespace carom
