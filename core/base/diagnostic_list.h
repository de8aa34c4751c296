// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/diagnostic.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

/// Collects the diagnostics of one stage. All are counted, but only the first `capacity` are kept, so that a
/// text full of mistakes costs neither memory nor the time to word the messages:
///
///     if (Diagnostic* diagnostic = list.report(code, range)) diagnostic->message = ...;
class DiagnosticList {
  public:
    /// At half of it a large text with a systematic mistake shows its end too late; at twice, the list of
    /// problems takes noticeably longer to fill.
    static constexpr std::size_t capacity = 1000;

    /// The new entry, to be worded before the next call; null where it is counted only.
    Diagnostic* report(DiagnosticCode code, SourceRange range) {
        ++m_total;
        if (m_listed.size() >= capacity) return nullptr;
        return &m_listed.emplace_back(Diagnostic{code, range, {}, {}, {}});
    }

    std::uint64_t total() const { return m_total; }
    const std::vector<Diagnostic>& listed() const { return m_listed; }
    std::vector<Diagnostic> take() { return std::move(m_listed); }

  private:
    std::vector<Diagnostic> m_listed;
    std::uint64_t m_total = 0;
};

} // namespace carom
