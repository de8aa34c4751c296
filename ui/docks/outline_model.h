// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/editor/live_build.h"
#include "ui/base/theme.h"

#include "core/language/navigation.h"

#include <QAbstractTableModel>
#include <QCache>
#include <QIcon>
#include <QRgb>

#include <utility>
#include <vector>

namespace carom {

/// The declarations of a build as rows, in the order of the text.
class OutlineModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum ColumnId { Name, Type, Line, ColumnCount };
    enum { FilterRole = Qt::UserRole };

    explicit OutlineModel(const Theme& theme, QObject* parent);

    void show(const SharedBuild& result);
    void setTheme(const Theme& theme);
    SourceRange rangeAt(int row) const { return entries()[static_cast<std::size_t>(row)].name; }
    /// Each once.
    QStringList typesWritten() const;
    /// The row whose declaration holds the place, or -1.
    int rowAt(std::uint32_t offset) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    const std::vector<OutlineEntry>& entries() const;
    QString nameOf(const OutlineEntry& entry) const;
    QVariant text(const OutlineEntry& entry, int column) const;
    QIcon swatch(const OutlineEntry& entry) const;

    SharedBuild m_result;
    QColor m_broken, m_muted;
    /// By colour and pixels a point. A new icon for every look would stay in the cache that Qt keeps of all
    /// pictures, 10 MiB in the end.
    mutable QCache<std::pair<QRgb, qreal>, QIcon> m_swatches{512};
};

} // namespace carom
