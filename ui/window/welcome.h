// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QString>

#include <vector>

class QListWidget;

namespace carom {

class Settings;

/// A scene that comes with the program.
struct GalleryScene {
    QString name;    ///< "pool_break"
    QString picture; ///< resource, made by packaging/gallery
    QString text;    ///< resource
};

/// In the order of resources/gallery/index.
std::vector<GalleryScene> galleryScenes();

/// What a session without a scene begins with: new, open, the files opened last, and the gallery.
class Welcome : public QDialog {
    Q_OBJECT
  public:
    Welcome(Settings& settings, QWidget* parent);

  Q_SIGNALS:
    void newWanted();
    void templateWanted();
    void openWanted();
    void tutorialWanted();
    void fileWanted(const QString& path);
    void sceneWanted(const QString& resource);

  private:
    QWidget* startColumn(const Settings& settings);
    QListWidget* gallery();
};

} // namespace carom
