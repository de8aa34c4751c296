// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace carom {

/// Threads for loops over independent bodies. Every element is computed by itself, so the bits do not depend
/// on the number of threads or on the division into parts. One thread at a time calls these, and no part
/// calls another loop of the same workers.
class Workers {
  public:
    /// `threads` includes the caller; 1 never starts another, and no more start than there are processors.
    /// They start with the first loop that is shared.
    explicit Workers(int threads);
    ~Workers();
    Workers(Workers&&) noexcept;
    Workers& operator=(Workers&&) noexcept;

    /// The calling thread alone.
    static Workers& alone();

    int threads() const { return m_threads; }

    /// How many elements are enough for a part if each takes so many nanoseconds: sharing a loop takes about
    /// .3 us. At half, small loops gain little by it; at twice, loops over some hundred bodies have one part.
    static constexpr std::size_t enoughOf(double nanoseconds) {
        return static_cast<std::size_t>(std::max(1.0, 2000 / nanoseconds));
    }

    /// Calls work(begin, end) for parts that together cover [0, count), each element once. There is one part
    /// if there are fewer than twice `least` elements; no part has fewer than that.
    template<class Work>
    void forRanges(std::size_t count, std::size_t least, const Work& work) {
        if (m_threads == 1 || count < 2 * least) return work(std::size_t{0}, count);
        const std::size_t parts = partsOf(count, least);
        forEach(parts, [&](std::size_t, std::size_t part) {
            work(part * count / parts, (part + 1) * count / parts);
        });
    }
    /// The same for elements that take as long as the motion of a free body.
    template<class Work>
    void forRanges(std::size_t count, const Work& work) {
        forRanges(count, enoughOf(5), work);
    }

    /// The same where parts find lists: work(begin, end, list) adds to one, and append(list) is called with
    /// each in the order of the parts, by the calling thread. What is one part adds to `all` itself.
    template<class List, class Work, class Append>
    void forLists(std::size_t count, std::size_t least, List& all, const Work& work, const Append& append) {
        if (m_threads == 1 || count < 2 * least) return work(std::size_t{0}, count, all);
        const std::size_t parts = partsOf(count, least);
        std::vector<List> lists(parts);
        forEach(parts, [&](std::size_t, std::size_t part) {
            work(part * count / parts, (part + 1) * count / parts, lists[part]);
        });
        for (List& list : lists) append(list);
    }
    /// The same of vectors, which are put one after the other.
    template<class Item, class Work>
    void forLists(std::size_t count, std::size_t least, std::vector<Item>& all, const Work& work) {
        forLists(count, least, all, work,
                 [&all](std::vector<Item>& list) { all.insert(all.end(), list.begin(), list.end()); });
    }

    /// The same where the caller keeps the lists of the parts, so that they take no memory anew: returns
    /// those that were filled, in the order of the parts.
    template<class List, class Work>
    std::span<List> forKeptLists(std::size_t count, std::size_t least, std::vector<List>& kept,
                                 const Work& work) {
        const std::size_t parts = m_threads == 1 || count < 2 * least ? 1 : partsOf(count, least);
        if (kept.size() < parts) kept.resize(parts);
        forEach(parts, [&](std::size_t, std::size_t part) {
            kept[part].clear();
            work(part * count / parts, (part + 1) * count / parts, kept[part]);
        });
        return std::span(kept).first(parts);
    }

    /// Calls work(thread, i) for every i in [0, count) once; calls at the same time have different threads,
    /// all below threads(). For elements that take long and unequally so: a thread takes the next when it is
    /// done.
    template<class Work>
    void forEach(std::size_t count, const Work& work) {
        if (m_threads == 1 || count < 2)
            for (std::size_t i = 0; i < count; ++i) work(std::size_t{0}, i);
        else
            share(count, {&work, [](const void* context, std::size_t thread, std::size_t i) {
                              (*static_cast<const Work*>(context))(thread, i);
                          }});
    }

  private:
    std::size_t partsOf(std::size_t count, std::size_t least) const {
        return std::min(count / least, 4 * static_cast<std::size_t>(m_threads));
    }
    /// A reference to a function of two numbers; the caller owns it.
    struct Call {
        const void* context = nullptr;
        void (*call)(const void* context, std::size_t, std::size_t) = nullptr;
    };
    void share(std::size_t parts, Call work);

    class Team;
    int m_threads;
    std::unique_ptr<Team> m_team;
};

} // namespace carom
