// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/output_dock.h"

#include <QFontDatabase>
#include <QPlainTextEdit>
#include <QTime>

namespace carom {

namespace {
/// Older ones are removed: at half sooner, at twice the text takes twice the memory.
constexpr int keptLines = 5000;
} // namespace

OutputDock::OutputDock(QWidget* parent) : Panel(tr("Output"), parent), m_text(new QPlainTextEdit(this)) {
    setObjectName(QStringLiteral("output"));
    m_text->setReadOnly(true);
    m_text->setAccessibleName(tr("Output"));
    m_text->setMaximumBlockCount(keptLines);
    m_text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    m_text->setPlaceholderText(tr("What is opened, built, run and saved is noted here, with times."));
    setWidget(m_text);
    setFocusProxy(m_text);
}

void OutputDock::add(const QString& line) {
    const QString time = QTime::currentTime().toString(QStringLiteral("hh:mm:ss"));
    m_text->appendPlainText(QStringLiteral("%1  %2").arg(time, line));
}

} // namespace carom

#include "moc_output_dock.cpp"
