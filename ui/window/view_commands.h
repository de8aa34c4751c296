// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/index.h"

#include <QObject>

class QMenu;
class QPoint;

namespace carom {

class LivePreview;
class MainWindow;

/// From where one looks at the scene: the views of the View menu, and the menu that a right click opens in
/// the viewport.
class ViewCommands : public QObject {
    Q_OBJECT
  public:
    ViewCommands(MainWindow& window, const LivePreview& preview);

    /// What a right click on a body, or with noBody on the background, offers; its caller owns it.
    QMenu* menuOf(BodyIndex body);

  private:
    void showMenu(const QPoint& place, BodyIndex body);

    MainWindow& m_window;
    const LivePreview& m_preview;
};

} // namespace carom
