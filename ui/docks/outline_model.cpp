// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/outline_model.h"

#include "ui/widgets/text_of.h"

#include <QGuiApplication>
#include <QIcon>
#include <QPainter>
#include <QPixmap>

#include <algorithm>

namespace carom {
namespace {

constexpr int swatchSize = 12;         // [px]
constexpr std::size_t mostTypes = 100; // more than there are: every other one is a mistake

/// Numbers end below each other.
QVariant alignmentOf(int column) {
    return column == OutlineModel::Line ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
}

} // namespace

OutlineModel::OutlineModel(const Theme& theme, QObject* parent) : QAbstractTableModel(parent) {
    setTheme(theme);
}

void OutlineModel::show(const SharedBuild& result) {
    beginResetModel();
    m_result = result;
    endResetModel();
}

void OutlineModel::setTheme(const Theme& theme) {
    m_broken = theme.error;
    m_muted = theme.mutedText;
    m_swatches.clear();
    if (rowCount() > 0) Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, ColumnCount - 1));
}

int OutlineModel::rowAt(std::uint32_t offset) const {
    const std::vector<OutlineEntry>& all = entries();
    const auto behind =
        std::upper_bound(all.begin(), all.end(), offset, [](std::uint32_t place, const OutlineEntry& entry) {
            return place < entry.range.offset;
        });
    if (behind == all.begin() || offset > std::prev(behind)->range.end()) return -1;
    return static_cast<int>(behind - all.begin()) - 1;
}

QStringList OutlineModel::typesWritten() const {
    std::vector<std::string_view> types;
    for (const OutlineEntry& entry : entries()) {
        if (types.size() == mostTypes) break;
        if (std::find(types.rbegin(), types.rend(), entry.type) == types.rend()) types.push_back(entry.type);
    }
    QStringList texts;
    for (const std::string_view type : types) texts.append(textOf(type));
    return texts;
}

int OutlineModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(entries().size());
}

int OutlineModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : ColumnCount; }

QVariant OutlineModel::data(const QModelIndex& index, int role) const {
    const OutlineEntry& entry = entries()[static_cast<std::size_t>(index.row())];
    switch (role) {
    case Qt::DisplayRole:
        return text(entry, index.column());
    case FilterRole:
        return nameOf(entry) + u' ' + textOf(entry.type);
    case Qt::ForegroundRole:
        if (!entry.built) return m_broken;
        return index.column() == Name && !entry.label.empty() ? QVariant() : QVariant(m_muted);
    case Qt::DecorationRole:
        return index.column() == Name ? swatch(entry) : QVariant();
    case Qt::TextAlignmentRole:
        return alignmentOf(index.column());
    case Qt::ToolTipRole:
        return entry.built ? QVariant() : tr("left out: there is a mistake in it");
    default:
        return {};
    }
}

const std::vector<OutlineEntry>& OutlineModel::entries() const {
    static const std::vector<OutlineEntry> none;
    return m_result ? m_result->outline : none;
}

/// The label, else the name messages give the body.
QString OutlineModel::nameOf(const OutlineEntry& entry) const {
    if (!entry.label.empty()) return textOf(entry.label);
    if (entry.body != noBody) return QString::fromStdString(m_result->scene().nameOf(entry.body));
    return textOf(entry.type);
}

QVariant OutlineModel::text(const OutlineEntry& entry, int column) const {
    if (column == Name) return nameOf(entry);
    if (column == Type) return textOf(entry.type);
    return m_result->build.analysis.lines.lineAt(entry.range.offset);
}

/// A dot in the body's colour; an empty one in front of what is no body.
QIcon OutlineModel::swatch(const OutlineEntry& entry) const {
    QColor colour = Qt::transparent;
    if (entry.body != noBody) {
        const Vec3& said = m_result->scene().bodies[entry.body].colour;
        colour = QColor::fromRgbF(static_cast<float>(said.x()), static_cast<float>(said.y()),
                                  static_cast<float>(said.z()));
    }
    const qreal density = qApp->devicePixelRatio(); // as sharp as the text beside it
    const std::pair<QRgb, qreal> key{colour.rgba(), density};
    if (const QIcon* made = m_swatches.object(key)) return *made;
    QPixmap dot(QSize(swatchSize, swatchSize) * density);
    dot.setDevicePixelRatio(density);
    dot.fill(Qt::transparent);
    if (entry.body != noBody) {
        QPainter painter(&dot);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(m_muted);
        painter.setBrush(colour);
        painter.drawEllipse(QRectF(1, 1, swatchSize - 2, swatchSize - 2));
    }
    QIcon icon(dot);
    icon.addPixmap(dot, QIcon::Selected); // the body's colour, not the selection's over it
    m_swatches.insert(key, new QIcon(icon));
    return icon;
}

QVariant OutlineModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::TextAlignmentRole) return alignmentOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    return section == Name ? tr("Name") : section == Type ? tr("Type") : tr("Line");
}

} // namespace carom

#include "moc_outline_model.cpp"
