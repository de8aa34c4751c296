// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/broadphase/bounding_tree.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

// Boxes in a leaf: more make the tree shorter and each comparison of two leaves dearer. Twice or half of this
// and of what follows costs time alone; the pairs are the same.
constexpr std::uint32_t leafSize = 4;
// Cost of a new tree, in node comparisons for each box and each level of the tree.
constexpr double buildCost = 1;
// From one escaped box in so many on, comparing the whole tree is cheaper than searching for each.
constexpr std::size_t fewEscaped = 8;
// A box is enlarged by its motion in so many frames, at least by a hundredth of its width, so that bodies at
// rest or in slow motion cost nothing; one that would need more than a quarter of its width is not enlarged:
// it leaves its box in any case, and a larger one would only overlap more others.
constexpr double framesAhead = 8, leastMargin = 0.01, mostMargin = 0.25;

double girthOf(const Aabb& box) { return box.size().sum(); }

} // namespace

void BoundingTree::update(const BroadphaseInput& input) {
    m_counters = {};
    m_escaped.clear();
    ++m_update;
    const std::size_t count = input.boxes.size();
    const double costOfNew = buildCost * static_cast<double>(count) * std::log2(2 + double(count));
    if (m_items.size() != count || m_regret > costOfNew) {
        build(input);
        compareAll();
        m_order.tidy(m_candidates, input);
    } else {
        renewFatBoxes(input);
        if (!m_escaped.empty()) {
            refit();
            if (m_escaped.size() > count / fewEscaped)
                compareAll();
            else
                lookUpEscaped();
            m_order.tidy(m_candidates, input);
        }
    }
    if (m_girth > m_girthWhenNew)
        m_regret += static_cast<double>(m_counters.cells) * (1 - m_girthWhenNew / m_girth);

    m_overlapping.clear();
    for (const PairKey key : m_candidates)
        if (overlap(input.boxes[firstOf(key)], input.boxes[secondOf(key)])) m_overlapping.push_back(key);
    translate(m_overlapping, input, m_pairs);

    m_counters.boxes = count;
    m_counters.pairs = m_pairs.size();
    m_counters.tested += m_candidates.size();
    m_counters.memoryBytes =
        m_nodes.capacity() * sizeof(Node) + m_items.capacity() * sizeof(Item) +
        m_fat.capacity() * sizeof(Aabb) + m_hasEscaped.capacity() +
        (m_placeOf.capacity() + m_since.capacity() + m_escaped.capacity() + m_stack.capacity()) *
            sizeof(std::uint32_t) +
        (m_candidates.capacity() + m_overlapping.capacity()) * sizeof(PairKey) + m_order.bytes() +
        m_pairs.capacity() * sizeof(BodyPair);
}

void BoundingTree::build(const BroadphaseInput& input) {
    const std::uint32_t count = static_cast<std::uint32_t>(input.boxes.size());
    const bool first = m_items.size() != count;
    m_items.resize(count);
    m_fat.resize(count);
    m_placeOf.resize(count);
    m_since.resize(count, m_update);
    m_hasEscaped.assign(count, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (first) m_fat[i] = input.boxes[i];
        m_fat[i] = fattened(input.boxes[i], i);
        m_since[i] = m_update;
        m_items[i] = {m_fat[i], i, input.mobile[i]};
    }
    m_nodes.clear();
    if (count > 0) buildNode(0, count);
    for (std::uint32_t p = 0; p < count; ++p) m_placeOf[m_items[p].entry] = p;
    refit();
    m_girthWhenNew = m_girth;
    m_regret = 0;
}

// Halves by the median of the centres along the axis they spread most on: the depth is bounded whatever the
// scene, and boxes with one centre do no harm.
std::uint32_t BoundingTree::buildNode(std::uint32_t first, std::uint32_t count) {
    const std::uint32_t index = static_cast<std::uint32_t>(m_nodes.size());
    m_nodes.push_back({{}, 0, first, count, 0});
    if (count <= leafSize) return index;
    const std::vector<Item>::iterator begin = m_items.begin() + first, end = begin + count;
    Vec3 least = begin->fat.centre(), most = least;
    for (std::vector<Item>::iterator item = begin + 1; item != end; ++item) {
        least = least.cwiseMin(item->fat.centre());
        most = most.cwiseMax(item->fat.centre());
    }
    Eigen::Index axis = 0;
    (most - least).maxCoeff(&axis);
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [axis](const Item& a, const Item& b) {
        return a.fat.lower[axis] + a.fat.upper[axis] < b.fat.lower[axis] + b.fat.upper[axis];
    });
    buildNode(first, half);
    const std::uint32_t right = buildNode(first + half, count - half);
    m_nodes[index].right = right;
    return index;
}

void BoundingTree::renewFatBoxes(const BroadphaseInput& input) {
    for (std::uint32_t i = 0; i < m_fat.size(); ++i) {
        const Aabb& box = input.boxes[i];
        const bool inside = contains(m_fat[i], box);
        m_hasEscaped[i] = inside ? 0 : 1;
        if (inside) continue;
        m_fat[i] = fattened(box, i);
        m_since[i] = m_update;
        m_items[m_placeOf[i]].fat = m_fat[i];
        m_escaped.push_back(m_placeOf[i]);
    }
}

// What it moved, or grew beyond its fat box, since that was made.
Aabb BoundingTree::fattened(const Aabb& box, std::uint32_t entry) const {
    const Aabb& last = m_fat[entry];
    const double moved = (box.centre() - last.centre()).cwiseAbs().maxCoeff();
    const double out = std::max((last.lower - box.lower).maxCoeff(), (box.upper - last.upper).maxCoeff());
    const double updates = std::max<std::uint32_t>(1, m_update - m_since[entry]);
    const double ahead = framesAhead * std::max(moved, out) / updates;
    const double width = (box.upper - box.lower).maxCoeff();
    return ahead > mostMargin * width ? box : grown(box, std::max(ahead, leastMargin * width));
}

// Children come after their parents, so one pass from the end meets every child before its parent.
void BoundingTree::refit() {
    m_girth = 0;
    for (std::size_t index = m_nodes.size(); index-- > 0;) {
        Node& node = m_nodes[index];
        if (node.right != 0) {
            const Node &left = m_nodes[index + 1], &right = m_nodes[node.right];
            node.box = united(left.box, right.box);
            node.mobile = left.mobile | right.mobile;
        } else {
            node.box = m_items[node.first].fat;
            node.mobile = m_items[node.first].mobile;
            for (std::uint32_t p = node.first + 1; p < node.first + node.count; ++p) {
                node.box = united(node.box, m_items[p].fat);
                node.mobile |= m_items[p].mobile;
            }
        }
        m_girth += girthOf(node.box);
    }
}

// Every pair lies within a leaf or between the two children of exactly one node.
void BoundingTree::compareAll() {
    m_candidates.clear();
    for (std::uint32_t index = 0; index < m_nodes.size(); ++index) {
        const Node& node = m_nodes[index];
        if (node.mobile == 0) continue;
        if (node.right == 0)
            compareWithin(node);
        else
            compare(m_nodes[index + 1], m_nodes[node.right]);
    }
}

void BoundingTree::compareWithin(const Node& leaf) {
    const std::uint32_t end = leaf.first + leaf.count;
    for (std::uint32_t p = leaf.first; p < end; ++p)
        for (std::uint32_t q = p + 1; q < end; ++q) note(m_items[p], m_items[q]);
}

void BoundingTree::compare(const Node& a, const Node& b) {
    ++m_counters.cells;
    if (!overlap(a.box, b.box) || (a.mobile | b.mobile) == 0) return;
    if (a.right == 0 && b.right == 0) {
        for (std::uint32_t p = a.first; p < a.first + a.count; ++p) {
            if (!overlap(m_items[p].fat, b.box)) continue;
            for (std::uint32_t q = b.first; q < b.first + b.count; ++q) note(m_items[p], m_items[q]);
        }
    } else if (b.right == 0 || (a.right != 0 && a.count >= b.count)) {
        compare((&a)[1], b);
        compare(m_nodes[a.right], b);
    } else {
        compare(a, (&b)[1]);
        compare(a, m_nodes[b.right]);
    }
}

// Pairs of boxes that both stayed are kept; those of an escaped one are found anew, once.
void BoundingTree::lookUpEscaped() {
    std::erase_if(m_candidates, [this](PairKey key) {
        return (m_hasEscaped[firstOf(key)] | m_hasEscaped[secondOf(key)]) != 0;
    });
    for (const std::uint32_t p : m_escaped) {
        const Item& item = m_items[p];
        m_stack.assign(1, 0);
        while (!m_stack.empty()) {
            const std::uint32_t index = m_stack.back();
            m_stack.pop_back();
            const Node& node = m_nodes[index];
            ++m_counters.cells;
            if (!overlap(item.fat, node.box) || (item.mobile | node.mobile) == 0) continue;
            if (node.right != 0) {
                m_stack.push_back(node.right);
                m_stack.push_back(index + 1);
                continue;
            }
            for (std::uint32_t q = node.first; q < node.first + node.count; ++q)
                if (q != p && !(q < p && m_hasEscaped[m_items[q].entry])) note(item, m_items[q]);
        }
    }
}

void BoundingTree::note(const Item& a, const Item& b) {
    ++m_counters.tested;
    if (overlap(a.fat, b.fat)) m_candidates.push_back(pairKey(a.entry, b.entry));
}

std::vector<Aabb> BoundingTree::structure() const {
    std::vector<Aabb> boxes;
    boxes.reserve(m_nodes.size());
    for (const Node& node : m_nodes) boxes.push_back(node.box);
    return boxes;
}

extern const BroadphaseRow boundingTreeRow;
constinit const BroadphaseRow boundingTreeRow = {
    .name = "bounding_tree",
    .title = "Bounding tree",
    .cost = "O(n log n + pairs) a frame of motion, O(n + pairs) at rest",
    .source = "G. van den Bergen, Efficient Collision Detection of Complex Deformable Models using AABB "
              "Trees, 1997",
    .create = createBroadphase<BoundingTree>,
};

} // namespace carom
