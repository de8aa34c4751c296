// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/problems_model.h"

#include "ui/widgets/text_of.h"

#include <limits>

namespace carom {
namespace {

/// Of the cells: in the heads the arrow of the order stands at the right.
QVariant alignmentOf(int column) {
    const bool figures = column == ProblemsModel::Line || column == ProblemsModel::Column;
    return figures ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
}

} // namespace

ProblemsModel::ProblemsModel(const Theme& theme, QObject* parent) : QAbstractTableModel(parent) {
    setTheme(theme);
}

void ProblemsModel::show(const SharedBuild& result) {
    beginResetModel();
    m_result = result;
    endResetModel();
}

void ProblemsModel::showRun(const std::optional<RunProblem>& problem) {
    beginResetModel();
    m_run = problem;
    endResetModel();
}

std::optional<std::int64_t> ProblemsModel::frameAt(int row) const {
    return m_run && row == ofText() ? std::optional(m_run->frame) : std::nullopt;
}

void ProblemsModel::setTheme(const Theme& theme) {
    const QString icon = QStringLiteral("problems");
    m_error = theme.icon(icon, theme.error);
    m_warning = theme.icon(icon, theme.warning);
    m_hint = theme.icon(icon, theme.hint);
    if (rowCount() > 0) Q_EMIT dataChanged(index(0, Message), index(rowCount() - 1, Message));
}

SourceRange ProblemsModel::rangeAt(int row) const {
    return m_result->build.diagnostics[static_cast<std::size_t>(row)].range;
}

int ProblemsModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : ofText() + (m_run ? 1 : 0);
}

/// Rows about the text.
int ProblemsModel::ofText() const {
    return m_result ? static_cast<int>(m_result->build.diagnostics.size()) : 0;
}

/// The row about the run has no place in the text.
QVariant ProblemsModel::ofRun(int column, int role) const {
    if (role == SortRole)
        return column == Message ? QVariant(static_cast<int>(Severity::Warning))
                                 : QVariant(std::numeric_limits<std::uint32_t>::max());
    if (role == Qt::ToolTipRole) return m_run->message;
    if (role == Qt::DecorationRole) return column == Message ? QVariant(m_warning) : QVariant();
    if (role == Qt::TextAlignmentRole) return alignmentOf(column);
    if (role != Qt::DisplayRole) return {};
    return column == Message ? m_run->message : column == Code ? tr("frame %1").arg(m_run->frame) : QString();
}

int ProblemsModel::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : ColumnCount; }

QVariant ProblemsModel::data(const QModelIndex& index, int role) const {
    if (index.row() >= ofText()) return ofRun(index.column(), role);
    const Diagnostic& diagnostic = m_result->build.diagnostics[static_cast<std::size_t>(index.row())];
    switch (role) {
    case Qt::DisplayRole:
        return text(diagnostic, index.column());
    case Qt::ToolTipRole:
        return text(diagnostic, Message);
    case SortRole:
        return sortKey(diagnostic, index.column());
    case Qt::DecorationRole:
        return index.column() == Message ? QVariant(iconOf(diagnostic.severity())) : QVariant();
    case Qt::TextAlignmentRole:
        return alignmentOf(index.column());
    default:
        return {};
    }
}

QVariant ProblemsModel::text(const Diagnostic& diagnostic, int column) const {
    const SourcePosition position = m_result->build.analysis.positionOf(diagnostic.range.offset);
    switch (column) {
    case Message:
        return QString::fromStdString(diagnostic.message);
    case Line:
        return position.line;
    case Column:
        return position.column;
    default: {
        const std::string_view code = rowOf(diagnostic.code).code;
        return textOf(code);
    }
    }
}

QVariant ProblemsModel::sortKey(const Diagnostic& diagnostic, int column) const {
    if (column == Message) return static_cast<int>(diagnostic.severity()); // the gravest first
    return column == Line ? QVariant(diagnostic.range.offset) : text(diagnostic, column);
}

QVariant ProblemsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
    switch (section) {
    case Message:
        return tr("Message");
    case Line:
        return tr("Line");
    case Column:
        return tr("Column");
    default:
        return tr("Code");
    }
}

QIcon ProblemsModel::iconOf(Severity severity) const {
    switch (severity) {
    case Severity::Error:
        return m_error;
    case Severity::Warning:
        return m_warning;
    case Severity::Hint:
        return m_hint;
    }
    return m_error;
}

} // namespace carom

#include "moc_problems_model.cpp"
