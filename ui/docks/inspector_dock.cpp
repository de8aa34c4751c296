// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/inspector_dock.h"

#include "core/simulation/quantities.h"
#include "ui/widgets/body_title.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/text_of.h"

#include <QHeaderView>
#include <QTreeWidget>

#include <cmath>

namespace carom {
namespace {

enum Column : int { Name, Value };

/// Of the value's cell: the figure without its unit, and the unit.
constexpr int figureRole = Qt::UserRole, unitRole = Qt::UserRole + 1;

constexpr int refreshInterval = 100; // [ms]
constexpr int digits = 6;            // significant: more change too quickly to be read

const QString nothing = QStringLiteral("–");

QString figure(double value) { return std::isfinite(value) ? QString::number(value, 'g', digits) : nothing; }

void setFigure(QTreeWidgetItem& row, const QString& value) {
    const QString unit = row.data(Value, unitRole).toString();
    row.setData(Value, figureRole, value);
    const bool bare = unit.isEmpty() || value.isEmpty() || value == nothing;
    const QString words = bare ? value : value + u' ' + unit;
    row.setText(Value, words);
    row.setToolTip(Value, words);
}

QString triple(const Vec3& v) {
    return QStringLiteral("%1, %2, %3").arg(figure(v.x()), figure(v.y()), figure(v.z()));
}

} // namespace

InspectorDock::InspectorDock(QWidget* parent)
    : QDockWidget(tr("Inspector"), parent), m_tree(new QTreeWidget),
      m_state(new EmptyState(m_tree, tr("The scene is empty.\nClick a body, or put the caret into its "
                                        "declaration, to see its values here."))) {
    setObjectName(QStringLiteral("inspector"));
    m_tree->setHeaderLabels({tr("Quantity"), tr("Value")});
    m_tree->headerItem()->setTextAlignment(Value, Qt::AlignRight | Qt::AlignVCenter);
    m_tree->setRootIsDecorated(false);
    m_tree->setIndentation(10);
    m_tree->setAlternatingRowColors(true);
    m_tree->setUniformRowHeights(true);
    m_tree->setAccessibleName(tr("Values of the selected body"));
    // In a narrow panel the names are cut, never the values; the mouse tells both.
    m_tree->header()->setSectionResizeMode(Name, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(Value, QHeaderView::ResizeToContents);
    m_tree->header()->setStretchLastSection(false);
    setWidget(m_state);
    setFocusProxy(m_tree);
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(refreshInterval);
    connect(&m_refresh, &QTimer::timeout, this, &InspectorDock::refresh);
    m_state->setEmpty(true);
}

void InspectorDock::showPipeline(std::shared_ptr<const Pipeline> pipeline) {
    m_pipeline = std::move(pipeline);
    m_snapshot.reset();
    m_before.reset();
    if (m_pipeline && m_body != noBody && m_body >= m_pipeline->bodies().count()) m_body = noBody;
    rebuild();
}

void InspectorDock::showSnapshot(std::shared_ptr<const Snapshot> snapshot) {
    if (!m_pipeline || snapshot->pose.size() != m_pipeline->bodies().count()) return;
    m_before = std::move(m_snapshot);
    m_snapshot = std::move(snapshot);
    if (!m_refresh.isActive()) m_refresh.start();
}

void InspectorDock::showBody(BodyIndex body) {
    if (m_body == body) return;
    m_body = body;
    rebuild();
}

QString InspectorDock::valueOf(const QString& name) const {
    for (QTreeWidgetItem* item : m_tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, Name))
        return item->data(Value, figureRole).toString();
    return {};
}

QTreeWidgetItem* InspectorDock::addGroup(const QString& title) {
    QTreeWidgetItem* group = new QTreeWidgetItem(m_tree, {title});
    QFont bold = m_tree->font();
    bold.setBold(true);
    group->setFont(Name, bold);
    group->setFirstColumnSpanned(true);
    group->setFlags(Qt::ItemIsEnabled);
    return group;
}

void InspectorDock::addRow(QTreeWidgetItem* group, const QString& name, const QString& value,
                           const QString& unit) {
    QTreeWidgetItem* row = new QTreeWidgetItem(group, {name});
    row->setToolTip(Name, name);
    row->setData(Value, unitRole, unit);
    setFigure(*row, value);
    row->setTextAlignment(Value, Qt::AlignRight | Qt::AlignVCenter);
}

void InspectorDock::rebuild() {
    m_tree->clear();
    m_live = nullptr;
    m_state->setEmpty(!m_pipeline || m_pipeline->bodies().count() == 0);
    if (!m_pipeline) return;
    const bool whole = m_body == noBody;
    if (!whole) addDeclared();
    const bool wall = !whole && isWall(m_pipeline->bodies().shape[m_body]);
    if (!wall) {
        m_live = addGroup(whole ? tr("The whole scene now") : tr("Now"));
        for (const QuantityRow& row : whole ? wholeQuantities() : bodyQuantities())
            if (!row.booked) // the run on screen keeps no ledger
                addRow(m_live, textOf(row.name), {}, textOf(row.unit));
    }
    m_tree->expandAll();
    refresh();
}

/// About the body's own axes; one row where they are the same.
void InspectorDock::addInertia(QTreeWidgetItem* group, const Vec3& inertia) {
    const QString unit = QStringLiteral("kg m²");
    if (inertia.x() == inertia.y() && inertia.y() == inertia.z()) {
        addRow(group, tr("moment of inertia"), figure(inertia.x()), unit);
        return;
    }
    for (const int axis : {0, 1, 2})
        addRow(group, tr("inertia about %1").arg(QChar(u'x' + axis)), figure(inertia[axis]), unit);
}

void InspectorDock::addDeclared() {
    const Scene& scene = m_pipeline->scene();
    const Body& body = scene.bodies[m_body];
    const Bodies& bodies = m_pipeline->bodies();
    QTreeWidgetItem* group = addGroup(bodyTitle(scene, m_body));
    if (const Sphere* sphere = std::get_if<Sphere>(&body.shape))
        addRow(group, tr("radius"), figure(sphere->radius), QStringLiteral("m"));
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&body.shape)) {
        addRow(group, tr("radius"), figure(cylinder->radius), QStringLiteral("m"));
        addRow(group, tr("height"), figure(2 * cylinder->halfHeight), QStringLiteral("m"));
    }
    if (const Cuboid* cuboid = std::get_if<Cuboid>(&body.shape))
        addRow(group, tr("size"), triple(2 * cuboid->halfSize), QStringLiteral("m"));
    if (const Wall* wall = std::get_if<Wall>(&body.shape)) {
        addRow(group, tr("normal"), triple(wall->normal), {});
        addRow(group, tr("distance from the origin"), figure(wall->offset), QStringLiteral("m"));
    }
    if (bodies.mobile[m_body] != 0) {
        addRow(group, tr("mass"), figure(bodies.mass[m_body]), QStringLiteral("kg"));
        addInertia(group, bodies.inertia[m_body]);
    } else {
        addRow(group, tr("mass"), tr("immobile"), {});
    }
    addRow(group, tr("elasticity"), figure(body.elastic), {});
    addRow(group, tr("friction"), figure(body.friction), {});
    addRow(group, tr("rolling resistance"), figure(body.rolling), QStringLiteral("m"));
}

void InspectorDock::refresh() {
    if (m_live == nullptr || !m_pipeline) return;
    Snapshot start;
    if (!m_snapshot) {
        const State& state = m_pipeline->initialState();
        start.pose = state.pose;
        start.velocity = state.velocity;
        start.angularVelocity = state.angularVelocity;
    }
    Moment moment = momentOf(*m_pipeline, m_snapshot ? *m_snapshot : start);
    if (m_before && m_snapshot && m_before->frame < m_snapshot->frame) {
        moment.velocityBefore = m_before->velocity;
        moment.elapsed = m_snapshot->time - m_before->time;
    }
    const std::span<const QuantityRow> rows = m_body == noBody ? wholeQuantities() : bodyQuantities();
    int child = 0;
    for (const QuantityRow& row : rows)
        if (!row.booked) setFigure(*m_live->child(child++), figure(row.measure(moment, m_body)));
}

} // namespace carom

#include "moc_inspector_dock.cpp"
