// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/broadphase/broadphase.h"
#include "core/broadphase/pair_keys.h"

// A binary tree of boxes: every node's box holds the boxes below it, so two subtrees whose boxes are apart
// have no pair between them. G. van den Bergen, "Efficient Collision Detection of Complex Deformable Models
// using AABB Trees", 1997: the tree is kept from frame to frame and refitted from the leaves up as its boxes
// move.
//
//        [ . . . . . . . ]         Three kinds of frame, from the cheapest:
//      [ . . . ]   [ . . . . ]     - no box left its fattened box: the pairs of fattened boxes are known, and
//     [ . ] [ . ]  [ . ] [ . . ]     only they are looked at;
//                                  - a few did: they alone are looked up in the refitted tree;
//                                  - many did: the refitted tree is compared with itself.
//
// The more its boxes have moved since it was built, the more nodes a comparison visits. The excess is added
// up, and when it exceeds the cost of a new tree, the tree is rebuilt: the total is at most twice that of
// rebuilding at the best times.

namespace carom {

class BoundingTree final : public Broadphase {
  public:
    void update(const BroadphaseInput& input) override;
    std::vector<Aabb> structure() const override;

  private:
    /// In the order of a walk from the root, left before right: the left child follows its parent.
    struct Node {
        Aabb box;
        std::uint32_t right = 0;  ///< child; 0 for a leaf
        std::uint32_t first = 0;  ///< of m_items: those below the node are contiguous
        std::uint32_t count = 0;  ///< of m_items
        std::uint32_t mobile = 0; ///< 1 if anything below can move
    };
    struct Item {
        Aabb fat;             ///< holds the body's box
        std::uint32_t entry;  ///< of the input
        std::uint32_t mobile; ///< 1 if it can move
    };

    void build(const BroadphaseInput& input);
    std::uint32_t buildNode(std::uint32_t first, std::uint32_t count);
    Aabb fattened(const Aabb& box, std::uint32_t entry) const;
    void renewFatBoxes(const BroadphaseInput& input);
    void refit();
    void compareAll();
    void compareWithin(const Node& leaf);
    void compare(const Node& a, const Node& b);
    void lookUpEscaped();
    void note(const Item& a, const Item& b);

    std::vector<Node> m_nodes;
    std::vector<Item> m_items;
    std::vector<Aabb> m_fat;                ///< of m_items, by entry: the check of every frame reads in order
    std::vector<std::uint32_t> m_placeOf;   ///< of m_items, by entry
    std::vector<std::uint32_t> m_since;     ///< the update that fattened the box, by entry
    std::vector<std::uint8_t> m_hasEscaped; ///< in this update, by entry
    std::vector<std::uint32_t> m_escaped;   ///< of m_items
    std::uint32_t m_update = 0;
    std::vector<std::uint32_t> m_stack;
    std::vector<PairKey> m_candidates; ///< pairs of overlapping fat boxes, ascending
    std::vector<PairKey> m_overlapping;
    PairOrder m_order;
    double m_girth = 0, m_girthWhenNew = 0; ///< the widths of all nodes added up [m]
    double m_regret = 0;                    ///< node comparisons a new tree would have saved
};

} // namespace carom
