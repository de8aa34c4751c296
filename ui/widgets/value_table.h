// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTableWidget>

#include <span>

namespace carom {

/// A table of figures with named rows and columns: read only, right aligned, copied as text with Ctrl+C. Rows
/// and columns are counted over the figures, without the names.
class ValueTable : public QTableWidget {
    Q_OBJECT

  public:
    ValueTable(const QStringList& rows, const QStringList& columns, QWidget* parent = nullptr);

    /// A figure that does not exist (NaN) is shown as a dash.
    void setValue(int row, int column, double value, int decimals = 3);
    QString text(int row, int column) const;
    void setColumnTitle(int column, const QString& title);
    /// A square of colour in front of a row's name.
    void setRowColour(int row, const QColor& colour);
    /// Puts a box before a row's name that says whether what it counts is shown elsewhere.
    void makeCheckable(int row);
    void setChecked(int row, bool checked);
    bool isChecked(int row) const;
    /// The selected cells, or the whole table, with the names of rows and columns; tabs between them.
    QString asText() const;

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void checked(int row, bool checked);

  protected:
    void keyPressEvent(QKeyEvent* event) override;
};

} // namespace carom
