// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"
#include "core/simulation/snapshot.h"
#include "ui/base/panel.h"
#include "ui/docks/value_slider.h"

#include <QTimer>

#include <initializer_list>
#include <memory>
#include <vector>

class QMenu;
class QTreeWidget;
class QTreeWidgetItem;

namespace carom {

class EmptyState;

/// Every value of the selected body with its unit: what the scene says of it, and what it has at the moment,
/// as the run goes on. Of the whole scene where no body is selected. What the scene says can be written here,
/// too.
class InspectorDock : public Panel {
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

    /// The last figures of that row, oldest first: what its curve shows.
    std::vector<double> curveOf(const QString& name) const;
    /// What a right click on the row of that name offers; the caller owns it. Null where it offers nothing.
    QMenu* menuOf(const QString& name);
    /// Puts a value into its field, as one does by typing it there.
    void edit(const QString& name, const QString& text);

  Q_SIGNALS:
    /// The user has written another value for a parameter of the body's declaration.
    void valueWanted(carom::BodyIndex body, const QString& parameter, const QString& value);
    /// Until slideEnded() the values that are wanted of a parameter are those a slider passes: one change.
    void slideBegan(carom::BodyIndex body, const QString& parameter);
    void slideEnded();
    /// A parameter of the body is to be swept: "radius", or "vel.x" with the component of a vector.
    void sweepWanted(carom::BodyIndex body, const QString& parameter);
    /// A value at the moment on screen is to be expected of the scene from now on.
    void expectationWanted(const carom::Expectation& expectation);

  protected:
    void resizeEvent(QResizeEvent* event) override;

  private:
    void addToCurve(QTreeWidgetItem& item, std::int64_t frame, double value) const;
    void rebuild();
    void fitColumns();
    void refresh();
    void addDeclared();
    void addInertia(QTreeWidgetItem* group, const Vec3& inertia);
    QTreeWidgetItem* addGroup(const QString& title);
    QTreeWidgetItem* addRow(QTreeWidgetItem* group, const QString& name, const QString& value,
                            const QString& unit);
    QTreeWidgetItem* addField(QTreeWidgetItem* group, const QString& name, const char* parameter,
                              std::initializer_list<double> values, const QString& unit);
    void addSlidingField(QTreeWidgetItem* group, const QString& name, const char* parameter, double value,
                         SliderRange range, const QString& unit);
    void addLength(QTreeWidgetItem* group, const QString& name, const char* parameter, double value,
                   const QString& unit);
    void connectSlider(ValueSlider& slider, QTreeWidgetItem* row);
    void endSlide();
    void addColour(QTreeWidgetItem* group, const Vec3& colour);
    void pickColour();
    void take(const QString& parameter, const QString& text);
    void showMenu(const QPoint& place);
    QMenu* declaredMenu(const QTreeWidgetItem& row);

    std::shared_ptr<const Pipeline> m_pipeline;
    std::shared_ptr<const Snapshot> m_snapshot, m_before; ///< shown, and the one before it
    BodyIndex m_body = noBody;
    std::int64_t m_curveFrame = 0; ///< of the last figures in the curves
    QTreeWidget* m_tree;
    EmptyState* m_state;
    QTreeWidgetItem* m_live = nullptr; ///< the group whose rows are the quantities in order
    bool m_isSliding = false;          ///< a slider is held: its row must stay
    bool m_isStale = false;            ///< and is to be made anew when it is let go
    QTimer m_refresh;                  ///< figures are readable a few times a second, not every frame
};

} // namespace carom
