// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <functional>

class QWidget;

namespace carom {

/// Asks where to write a file that is to be called `name`; `filters` are as QFileDialog has them, the usual
/// one first. Begins where the user opened or wrote a file last. The path always has an ending, at need the
/// chosen filter's; it is empty if the user changed their mind. Before a file is replaced the user is asked:
/// about the one of that path, or the one that `replaced` names, of which an empty one is none.
using Replaced = std::function<QString(const QString& path)>;
QString askWhereToSave(QWidget* parent, const QString& title, const QString& name, const QString& filters,
                       const Replaced& replaced = {});

/// The next question begins in the folder of this file.
void rememberFolderOf(const QString& path);

} // namespace carom
