// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/inspector_dock.h"

#include "core/base/text.h"
#include "core/expectations/expectation_proposals.h"
#include "core/scene/schema.h"
#include "core/simulation/quantities.h"
#include "ui/base/pauses.h"
#include "ui/widgets/body_title.h"
#include "ui/widgets/colour_picker.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/expect_menu.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QPainter>
#include <QPolygonF>
#include <QLineEdit>
#include <QMenu>
#include <QMouseEvent>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QTreeWidget>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace carom {
namespace {

/// The curve stands between the other two; a slider where a value of the scene has one.
enum Column : int { Name, Value, Curve };

/// Of the value's cell: the figure without its unit, and the unit.
constexpr int figureRole = Qt::UserRole, unitRole = Qt::UserRole + 1;
/// Of a value that can be written: its parameter, and all its digits.
constexpr int parameterRole = Qt::UserRole + 2, literalRole = Qt::UserRole + 3;
/// Of the curve's cell: the last figures, oldest first.
constexpr int curveRole = Qt::UserRole + 4;
/// Of the name's cell of a quantity: what it was when it was shown, with all digits.
constexpr int measuredRole = Qt::UserRole + 5;
/// Of a value's cell: nothing stands in the curve's beside it, so that it may reach there.
constexpr int spreadsRole = Qt::UserRole + 6;
constexpr qsizetype mostFigures = 120; // of a curve: twelve seconds; twice as many have two a pixel
constexpr int curveWidth = 56;         // [px]
constexpr int leastWidth = 250;        // [px] of a panel that has room for curves and sliders
constexpr int leastNames = 96;         // [px] that names keep beside them

/// [ms]; at a tenth figures change too fast to be read, at ten times they lag.
constexpr int refreshInterval = 100;
constexpr int digits = 6;          // significant: more change too quickly to be read
constexpr int digitsOfSeveral = 3; // where several figures share a cell; its tip has all

/// Of core, which speaks English.
QString translated(std::string_view title) {
    return QCoreApplication::translate("carom::Core", std::string(title).c_str());
}

const QString nothing = QStringLiteral("–");
const QString colourParameter = QStringLiteral("colour");

QColor shownColour(const Vec3& colour) {
    return QColor::fromRgbF(static_cast<float>(colour.x()), static_cast<float>(colour.y()),
                            static_cast<float>(colour.z()));
}

QString figure(double value, int significant = digits) {
    return std::isfinite(value) ? QString::number(value, 'g', significant) : nothing;
}

/// The name that the scene language has for it, or how much red, green and blue it is.
QString wordsFor(const Vec3& colour) {
    for (const NamedColour& named : namedColours())
        if (named.colour == colour) return textOf(named.name);
    constexpr int decimals = 2;
    QStringList parts;
    for (const double part : colour) parts += QString::number(part, 'f', decimals);
    return parts.join(QStringLiteral(", "));
}

void setFigure(QTreeWidgetItem& row, const QString& value) {
    const QString unit = row.data(Value, unitRole).toString();
    const bool bare = unit.isEmpty() || value.isEmpty() || value == nothing;
    const QString words = bare ? value : value + u' ' + unit;
    {
        // The tree measures its rows with every change that it is told of; one tells of all three.
        const QSignalBlocker untold(row.treeWidget() != nullptr ? row.treeWidget()->model() : nullptr);
        row.setData(Value, figureRole, value);
        row.setToolTip(Value, words);
    }
    row.setText(Value, words);
}

/// Numbers with commas between them, as the scene language writes them.
bool isValue(const QString& text) {
    static const QRegularExpression numbers(QStringLiteral(
        R"(^\s*-?\s*(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?(\s*,\s*-?\s*(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?){0,2}\s*$)"));
    return numbers.match(text).hasMatch();
}

/// A field where a value of the declaration stands, with all digits it has.
class ValueField : public QStyledItemDelegate {
  public:
    using Take = std::function<void(const QString& parameter, const QString& text)>;
    ValueField(Take take, std::function<void()> pickColour, QTreeWidget* tree)
        : QStyledItemDelegate(tree), m_tree(tree), m_take(std::move(take)),
          m_pickColour(std::move(pickColour)) {}

    QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        const QSize hint = QStyledItemDelegate::sizeHint(option, index);
        return {std::max(0, hint.width() - spreadOf(index)), hint.height()};
    }
    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        QStyleOptionViewItem wide = option;
        wide.rect.setLeft(option.rect.left() - spreadOf(index));
        QStyledItemDelegate::paint(painter, wide, index);
    }
    void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const override {
        editor->setGeometry(option.rect.adjusted(-spreadOf(index), 0, 0, 0));
    }
    /// A click on a colour's square asks for another one.
    bool editorEvent(QEvent* event, QAbstractItemModel* model, const QStyleOptionViewItem& option,
                     const QModelIndex& index) override {
        if (event->type() == QEvent::MouseButtonRelease &&
            index.data(parameterRole).toString() == colourParameter) {
            const QMouseEvent& mouse = static_cast<QMouseEvent&>(*event);
            QStyleOptionViewItem shown = option;
            initStyleOption(&shown, index);
            const QRect square =
                m_tree->style()->subElementRect(QStyle::SE_ItemViewItemDecoration, &shown, m_tree);
            if (mouse.button() == Qt::LeftButton && square.contains(mouse.position().toPoint()))
                m_pickColour();
        }
        return QStyledItemDelegate::editorEvent(event, model, option, index);
    }

    QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem&,
                          const QModelIndex& index) const override {
        const QVariant parameter = index.data(parameterRole);
        if (parameter.toString() == colourParameter) m_pickColour();
        if (!parameter.isValid() || parameter.toString() == colourParameter) return nullptr;
        QLineEdit* field = new QLineEdit(parent);
        field->setObjectName(QStringLiteral("valueField"));
        field->setAlignment(Qt::AlignRight);
        field->setFrame(false);
        return field;
    }
    void setEditorData(QWidget* editor, const QModelIndex& index) const override {
        static_cast<QLineEdit*>(editor)->setText(index.data(literalRole).toString());
    }
    void setModelData(QWidget* editor, QAbstractItemModel*, const QModelIndex& index) const override {
        const QString text = static_cast<QLineEdit*>(editor)->text();
        if (text != index.data(literalRole).toString()) m_take(index.data(parameterRole).toString(), text);
    }

  private:
    /// How far a value reaches into the curves' column [px].
    int spreadOf(const QModelIndex& index) const {
        return index.data(spreadsRole).toBool() && !m_tree->isColumnHidden(Curve) ? curveWidth : 0;
    }

    QTreeWidget* m_tree;
    Take m_take;
    std::function<void()> m_pickColour;
};

/// The last figures as a line, from their least to their greatest.
class CurveCell : public QStyledItemDelegate {
  public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& option,
               const QModelIndex& index) const override {
        QStyledItemDelegate::paint(painter, option, index);
        const QList<double> figures = index.data(curveRole).value<QList<double>>();
        if (figures.size() < 2) return;
        const auto [least, most] = std::minmax_element(figures.begin(), figures.end());
        const QRectF place = QRectF(option.rect).adjusted(3, 3.5, -3, -3.5);
        const double range = *most - *least;
        QPolygonF line;
        for (qsizetype i = 0; i < figures.size(); ++i) {
            const double across = static_cast<double>(i) / static_cast<double>(figures.size() - 1);
            const double up = range > 0 ? (figures[i] - *least) / range : 0.5;
            line += QPointF(place.left() + across * place.width(), place.bottom() - up * place.height());
        }
        painter->save();
        painter->setRenderHint(QPainter::Antialiasing);
        painter->setPen(QPen(option.palette.color(QPalette::Highlight), 1.2));
        painter->drawPolyline(line);
        painter->restore();
    }
};

QString triple(const Vec3& v) {
    return QStringLiteral("%1, %2, %3").arg(figure(v.x()), figure(v.y()), figure(v.z()));
}

} // namespace

InspectorDock::InspectorDock(QWidget* parent)
    : Panel(tr("Inspector"), parent), m_tree(new QTreeWidget),
      m_state(new EmptyState(m_tree, tr("The scene is empty.\nClick a body, or put the caret into its "
                                        "declaration, to see its values here."))) {
    setObjectName(QStringLiteral("inspector"));
    m_tree->setHeaderLabels({tr("Quantity"), tr("Value"), QString()});
    m_tree->setItemDelegateForColumn(Curve, new CurveCell(m_tree));
    m_tree->headerItem()->setTextAlignment(Value, Qt::AlignRight | Qt::AlignVCenter);
    m_tree->setRootIsDecorated(false);
    m_tree->setIndentation(10);
    m_tree->setAlternatingRowColors(true);
    m_tree->setUniformRowHeights(true);
    m_tree->setTextElideMode(Qt::ElideMiddle); // the axis at a name's end tells it from the next
    m_tree->setAccessibleName(tr("Values of the selected body"));
    m_tree->setItemDelegateForColumn(
        Value,
        new ValueField([this](const QString& parameter, const QString& text) { take(parameter, text); },
                       [this] { pickColour(); }, m_tree));
    m_tree->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
    // In a narrow panel the names are cut, never the values; the mouse tells both.
    m_tree->header()->setSectionResizeMode(Name, QHeaderView::Stretch);
    m_tree->header()->setSectionResizeMode(Value, QHeaderView::ResizeToContents);
    m_tree->header()->setStretchLastSection(false);
    m_tree->header()->setSectionResizeMode(Curve, QHeaderView::Fixed);
    m_tree->header()->resizeSection(Curve, curveWidth);
    m_tree->header()->moveSection(Curve, Value);
    m_tree->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(m_tree, &QWidget::customContextMenuRequested, this, &InspectorDock::showMenu);
    setWidget(m_state);
    setFocusProxy(m_tree);
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(pauseOf(refreshInterval));
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

void InspectorDock::edit(const QString& name, const QString& text) {
    for (const QTreeWidgetItem* item : m_tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, Name))
        if (item->data(Value, parameterRole).isValid())
            take(item->data(Value, parameterRole).toString(), text);
}

void InspectorDock::take(const QString& parameter, const QString& text) {
    if (isValue(text)) Q_EMIT valueWanted(m_body, parameter, text.trimmed());
}

/// Of a value that the scene says.
QMenu* InspectorDock::declaredMenu(const QTreeWidgetItem& row) {
    const QString parameter = row.data(Value, parameterRole).toString();
    if (parameter.isEmpty() || parameter == colourParameter || m_pipeline->scene().isGenerated(m_body))
        return nullptr;
    QMenu* menu = new QMenu(this);
    const auto offer = [&](const QString& words, const QString& path) {
        connect(menu->addAction(words), &QAction::triggered, this,
                [this, path, body = m_body] { Q_EMIT sweepWanted(body, path); });
    };
    if (!row.data(Value, literalRole).toString().contains(u',')) {
        offer(tr("Sweep this value…"), parameter);
        return menu;
    }
    for (const char* component : {"x", "y", "z"})
        offer(tr("Sweep its %1…").arg(QLatin1StringView(component)),
              parameter + u'.' + QLatin1StringView(component));
    return menu;
}

QMenu* InspectorDock::menuOf(const QString& name) {
    for (const QTreeWidgetItem* item : m_tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, Name))
        if (item->data(Value, parameterRole).isValid()) return declaredMenu(*item);
    if (m_live == nullptr) return nullptr;
    const std::span<const QuantityRow> rows = m_body == noBody ? wholeQuantities() : bodyQuantities();
    for (int i = 0; i < m_live->childCount(); ++i) {
        if (m_live->child(i)->text(Name) != name) continue;
        const auto row = std::find_if(rows.begin(), rows.end(), [&name](const QuantityRow& one) {
            return !one.audited && textOf(one.name) == name;
        });
        const double value = m_live->child(i)->data(Name, measuredRole).toDouble();
        const double time = static_cast<double>(m_curveFrame) * m_pipeline->settings().step;
        QMenu* menu = new QMenu(this);
        fillExpectMenu(
            *menu, m_pipeline->scene(),
            proposalsFor({.quantity = &*row, .body = m_body, .time = time, .low = value, .high = value}),
            [this](const Expectation& chosen) { Q_EMIT expectationWanted(chosen); });
        return menu;
    }
    return nullptr;
}

void InspectorDock::showMenu(const QPoint& place) {
    const QTreeWidgetItem* item = m_tree->itemAt(place);
    if (item == nullptr || item->parent() == nullptr) return;
    QMenu* menu = menuOf(item->text(Name));
    if (menu == nullptr) return;
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(m_tree->viewport()->mapToGlobal(place));
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

QTreeWidgetItem* InspectorDock::addRow(QTreeWidgetItem* group, const QString& name, const QString& value,
                                       const QString& unit) {
    QTreeWidgetItem* row = new QTreeWidgetItem(group, {name});
    row->setToolTip(Name, name);
    row->setData(Value, unitRole, unit);
    setFigure(*row, value);
    row->setTextAlignment(Value, Qt::AlignRight | Qt::AlignVCenter);
    row->setData(Value, spreadsRole, group != m_live);
    return row;
}

/// A value that can be written, by a double click or F2.
QTreeWidgetItem* InspectorDock::addField(QTreeWidgetItem* group, const QString& name, const char* parameter,
                                         std::initializer_list<double> values, const QString& unit) {
    QStringList shown, whole;
    for (const double value : values) {
        shown += figure(value, values.size() > 1 ? digitsOfSeveral : digits);
        whole += QString::fromStdString(shortest(value));
    }
    QTreeWidgetItem* row = addRow(group, name, shown.join(QStringLiteral(", ")), unit);
    row->setFlags(row->flags() | Qt::ItemIsEditable);
    row->setData(Value, parameterRole, QString::fromLatin1(parameter));
    row->setData(Value, literalRole, whole.join(QStringLiteral(", ")));
    if (values.size() > 1) row->setToolTip(Value, (whole.join(QStringLiteral(", ")) + u' ' + unit).trimmed());
    return row;
}

void InspectorDock::addSlidingField(QTreeWidgetItem* group, const QString& name, const char* parameter,
                                    double value, SliderRange range, const QString& unit) {
    QTreeWidgetItem* row = addField(group, name, parameter, {value}, unit);
    if (m_pipeline->scene().isGenerated(m_body)) return; // its figures stand nowhere in the text
    ValueSlider* slider = new ValueSlider(value, range);
    slider->setObjectName(QLatin1StringView(parameter) + QStringLiteral("Slider"));
    slider->setAccessibleName(name);
    row->setData(Value, spreadsRole, false);
    m_tree->setItemWidget(row, Curve, slider);
    connectSlider(*slider, row);
}

/// What must stay above 0 stands in the middle, and can be doubled at once.
void InspectorDock::addLength(QTreeWidgetItem* group, const QString& name, const char* parameter,
                              double value, const QString& unit) {
    addSlidingField(group, name, parameter, value, {.most = 2 * value, .takesZero = false}, unit);
}

void InspectorDock::connectSlider(ValueSlider& slider, QTreeWidgetItem* row) {
    const QString parameter = row->data(Value, parameterRole).toString();
    connect(&slider, &QSlider::sliderPressed, this, [this, parameter] {
        m_isSliding = true;
        Q_EMIT slideBegan(m_body, parameter);
    });
    connect(&slider, &QSlider::sliderReleased, this, &InspectorDock::endSlide);
    connect(&slider, &QSlider::valueChanged, this, [this, &slider, row, parameter] {
        setFigure(*row, slider.text());
        Q_EMIT valueWanted(m_body, parameter, slider.text());
    });
}

void InspectorDock::endSlide() {
    if (!std::exchange(m_isSliding, false)) return;
    Q_EMIT slideEnded();
    // Later: the slider itself says this.
    if (std::exchange(m_isStale, false)) QTimer::singleShot(0, this, &InspectorDock::rebuild);
}

void InspectorDock::rebuild() {
    m_isStale = m_isSliding;
    if (m_isSliding) return;
    QString inUse;
    for (const ValueSlider* one : m_tree->findChildren<ValueSlider*>())
        if (one->hasFocus()) inUse = one->objectName();
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
            if (!row.audited) // what one frame books says little
                addRow(m_live, textOf(row.name), {}, textOf(row.unit));
    }
    m_tree->expandAll();
    refresh();
    fitColumns();
    if (inUse.isEmpty()) return; // by keys, which go on with the new one
    for (ValueSlider* one : m_tree->findChildren<ValueSlider*>(inUse)) one->setFocus();
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

void InspectorDock::addColour(QTreeWidgetItem* group, const Vec3& colour) {
    addField(group, tr("colour"), "colour", {colour.x(), colour.y(), colour.z()}, {});
    QPixmap square(12, 12);
    square.fill(shownColour(colour));
    QTreeWidgetItem* row = group->child(group->childCount() - 1);
    setFigure(*row, wordsFor(colour));
    row->setIcon(Value, QIcon(square));
    row->setData(Value, spreadsRole, false);
    row->setToolTip(Value, tr("A click on the square chooses another one"));
}

void InspectorDock::pickColour() {
    if (m_body == noBody) return;
    carom::pickColour(
        this, shownColour(m_pipeline->scene().bodies[m_body].colour),
        [this, body = m_body](const QString& text) { Q_EMIT valueWanted(body, colourParameter, text); });
}

void InspectorDock::addDeclared() {
    const Scene& scene = m_pipeline->scene();
    const Body& body = scene.bodies[m_body];
    const Bodies& bodies = m_pipeline->bodies();
    QTreeWidgetItem* group = addGroup(bodyTitle(scene, m_body));
    const QString metres = QStringLiteral("m");
    if (const Sphere* sphere = std::get_if<Sphere>(&body.shape))
        addLength(group, tr("radius"), "radius", sphere->radius, metres);
    if (const Cylinder* cylinder = std::get_if<Cylinder>(&body.shape)) {
        addLength(group, tr("radius"), "radius", cylinder->radius, metres);
        addLength(group, tr("height"), "height", 2 * cylinder->halfHeight, metres);
    }
    if (const Cuboid* cuboid = std::get_if<Cuboid>(&body.shape)) {
        const Vec3 size = 2 * cuboid->halfSize;
        addField(group, tr("size"), "size", {size.x(), size.y(), size.z()}, metres);
    }
    if (const Wall* wall = std::get_if<Wall>(&body.shape)) {
        addRow(group, tr("normal"), triple(wall->normal), {});
        addRow(group, tr("distance from the origin"), figure(wall->offset), metres);
    } else {
        const Vec3 &at = body.pose.position, &moving = body.velocity;
        addField(group, tr("position at start"), "centre", {at.x(), at.y(), at.z()}, metres);
        addField(group, tr("velocity at start"), "vel", {moving.x(), moving.y(), moving.z()},
                 QStringLiteral("m/s"));
    }
    if (bodies.mobile[m_body] != 0) {
        addLength(group, tr("mass"), "mass", bodies.mass[m_body], QStringLiteral("kg"));
        addInertia(group, bodies.inertia[m_body]);
    } else {
        addRow(group, tr("mass"), tr("immobile"), {});
    }
    addColour(group, body.colour);
    // From 0 as far as it usually reaches, or twice as far as it is where that is more.
    for (const ParameterRow& row : findDeclaration(nameOf(kindOf(body.shape)))->parameters) {
        if (row.title.empty() || (row.ofMoving && bodies.mobile[m_body] == 0)) continue;
        const double value = numberOf(row, body);
        addSlidingField(group, translated(row.title), row.name.data(), value,
                        {.most = value > row.typical ? 2 * value : row.typical}, textOf(row.unit));
    }
}

/// Each frame once; one that lies before the last begins anew.
void InspectorDock::addToCurve(QTreeWidgetItem& item, std::int64_t frame, double value) const {
    QList<double> figures = item.data(Curve, curveRole).value<QList<double>>();
    if (frame < m_curveFrame) figures.clear();
    if (!figures.isEmpty() && frame == m_curveFrame) return;
    if (!std::isfinite(value)) return;
    if (figures.size() == mostFigures) figures.removeFirst();
    figures += value;
    item.setData(Curve, curveRole, QVariant::fromValue(figures));
}

std::vector<double> InspectorDock::curveOf(const QString& name) const {
    for (const QTreeWidgetItem* item : m_tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, Name)) {
        const QList<double> figures = item->data(Curve, curveRole).value<QList<double>>();
        return {figures.begin(), figures.end()};
    }
    return {};
}

void InspectorDock::resizeEvent(QResizeEvent* event) {
    Panel::resizeEvent(event);
    fitColumns();
}

/// Curves and sliders stand there where names and values have room beside them.
void InspectorDock::fitColumns() {
    m_tree->setColumnHidden(Curve, false); // values reach into it
    const int values = static_cast<const QAbstractItemView*>(m_tree)->sizeHintForColumn(Value);
    const int names = width() - curveWidth - values;
    m_tree->setColumnHidden(Curve, width() < leastWidth || names < leastNames);
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
    const std::int64_t frame = m_snapshot ? m_snapshot->frame : 0;
    for (const QuantityRow& row : rows) {
        if (row.audited) continue;
        QTreeWidgetItem& item = *m_live->child(child++);
        const double value = row.measure(moment, m_body);
        setFigure(item, figure(value));
        item.setData(Name, measuredRole, value);
        addToCurve(item, frame, value);
    }
    m_curveFrame = frame;
}

} // namespace carom

#include "moc_inspector_dock.cpp"
