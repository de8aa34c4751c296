// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"

#include <QDockWidget>
#include <QTimer>

#include <memory>

class QTreeWidget;
class QTreeWidgetItem;

namespace carom {

class EmptyState;

/// Every value of the selected body with its unit: what the scene says of it, and what it has at the moment,
/// as the run goes on. Of the whole scene where no body is selected.
class InspectorDock : public QDockWidget {
    Q_OBJECT

  public:
    explicit InspectorDock(QWidget* parent = nullptr);

    /// Another scene, at its start.
    void showPipeline(std::shared_ptr<const Pipeline> pipeline);
    void showSnapshot(std::shared_ptr<const Snapshot> snapshot);
    /// noBody: the whole.
    void showBody(BodyIndex body);

    /// The text in the row of that name, empty where there is none: "position x" → "1.25".
    QString valueOf(const QString& name) const;

  private:
    void rebuild();
    void refresh();
    void addDeclared();
    void addInertia(QTreeWidgetItem* group, const Vec3& inertia);
    QTreeWidgetItem* addGroup(const QString& title);
    void addRow(QTreeWidgetItem* group, const QString& name, const QString& value, const QString& unit);

    std::shared_ptr<const Pipeline> m_pipeline;
    std::shared_ptr<const Snapshot> m_snapshot, m_before; ///< shown, and the one before it
    BodyIndex m_body = noBody;
    QTreeWidget* m_tree;
    EmptyState* m_state;
    QTreeWidgetItem* m_live = nullptr; ///< the group whose rows are the quantities in order
    QTimer m_refresh;                  ///< figures are readable a few times a second, not every frame
};

} // namespace carom
