// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/breakpoint.h"
#include "core/simulation/pipeline.h"
#include "ui/base/panel.h"

#include <memory>
#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QToolButton;

namespace carom {

class BodyBox;

class EmptyState;

/// The events at which a run stops: a contact, a depth, a drift of energy, a speed, a plane crossed. Each can
/// be switched off. Bodies are remembered by name, so breakpoints survive an edit.
class BreakpointsDock : public Panel {
    Q_OBJECT

  public:
    explicit BreakpointsDock(QWidget* parent = nullptr);

    /// The scene that runs; says changed().
    void showPipeline(std::shared_ptr<const Pipeline> pipeline);
    /// What the breakpoint of that place in changed() waits for: "contact of left and the floor".
    QString titleOf(std::size_t breakpoint) const;
    bool empty() const { return m_set.empty(); }

  Q_SIGNALS:
    /// Those that are on and whose bodies are in the scene.
    void changed(const std::vector<carom::Breakpoint>& breakpoints);
    /// To the last event before the frame on screen.
    void backWanted();

  private:
    struct Entry {
        Breakpoint breakpoint;
        QString a, b; ///< names; empty: any body
    };

    void layOut();
    void showFields();
    void add();
    void remove();
    void report();
    QString wordsOf(const Entry& entry) const;
    BodyIndex bodyNamed(const QString& name) const;

    std::shared_ptr<const Pipeline> m_pipeline;
    std::vector<Entry> m_entries;   ///< as in the list
    std::vector<std::size_t> m_set; ///< of m_entries, what changed() said last
    QComboBox* m_kind;
    BodyBox* m_a;
    BodyBox* m_b;
    QComboBox* m_axis;
    QLabel* m_limitName;
    QDoubleSpinBox* m_limit;
    QToolButton* m_add;
    QToolButton* m_remove;
    QToolButton* m_back;
    QListWidget* m_list;
    EmptyState* m_state;
};

} // namespace carom
