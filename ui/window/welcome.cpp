// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/welcome.h"

#include "ui/widgets/resources.h"
#include "ui/base/plain_words.h"
#include "ui/base/settings.h"

#include <QCheckBox>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QVBoxLayout>

namespace carom {
namespace {

constexpr QSize welcomeSize{1026, 680}; // [px] three columns of the gallery, and no more
constexpr QSize pictureSize{200, 125};  // [px] of a gallery picture on screen
constexpr int columnWidth = 280;        // [px]
constexpr qsizetype recentShown = 6;

/// The comment a scene begins with: what it shows.
QString headOf(const QString& resourceName) {
    QStringList lines;
    for (const QByteArray& line : resource(resourceName).split('\n')) {
        if (!line.startsWith("//") && !line.startsWith("#")) break;
        lines.append(QString::fromUtf8(line.mid(line.startsWith("#") ? 1 : 2)).trimmed());
    }
    return lines.join(u' ').trimmed();
}

/// "pool_break" is "Pool break", "hard/09_middle_axis" is "9: middle axis", by the number of the hard case.
QString titleOf(const QString& name) {
    QString title = name.section(u'/', -1).replace(u'_', u' ');
    if (!name.contains(u'/')) {
        title[0] = title[0].toUpper();
        return title;
    }
    return QStringLiteral("%1: %2").arg(title.section(u' ', 0, 0).toInt()).arg(title.section(u' ', 1));
}

} // namespace

std::vector<GalleryScene> galleryScenes() {
    std::vector<GalleryScene> scenes;
    for (const QByteArray& line : resource(QStringLiteral("gallery/index")).split('\n')) {
        const QString name = QString::fromUtf8(line).section(u' ', 0, 0);
        if (name.isEmpty() || name.startsWith(u'#') || line.endsWith(" -")) continue;
        scenes.push_back(
            {name, QStringLiteral(":/gallery/%1.png").arg(name), QStringLiteral("scenes/%1.sdl").arg(name)});
    }
    return scenes;
}

Welcome::Welcome(Settings& settings, QWidget* parent) : QDialog(parent) {
    setObjectName(QStringLiteral("welcome"));
    setWindowTitle(tr("Welcome to Carom"));
    QHBoxLayout* row = new QHBoxLayout;
    row->setSpacing(20);
    row->addWidget(startColumn(settings));
    row->addWidget(gallery(), 1);
    QCheckBox* atStart = new QCheckBox(tr("Show this at the start when there is no scene to go on with"));
    atStart->setChecked(settings.welcomeAtStart());
    connect(atStart, &QCheckBox::toggled, this,
            [&settings](bool shown) { settings.setWelcomeAtStart(shown); });
    QPushButton* close = new QPushButton(tr("&Close"));
    connect(close, &QPushButton::clicked, this, &QDialog::reject);
    QHBoxLayout* foot = new QHBoxLayout;
    foot->addWidget(atStart, 1);
    foot->addWidget(close);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->setContentsMargins(20, 20, 20, 14);
    column->setSpacing(14);
    column->addLayout(row, 1);
    column->addLayout(foot);
    resize(welcomeSize);
}

QWidget* Welcome::startColumn(const Settings& settings) {
    QWidget* side = new QWidget;
    side->setFixedWidth(columnWidth);
    QVBoxLayout* column = new QVBoxLayout(side);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(6);
    QLabel* head = new QLabel(tr("<h1>Carom</h1><p>Scenes of rigid bodies: written, watched, measured.</p>"));
    head->setWordWrap(true);
    column->addWidget(head);
    const auto button = [&](const QString& text, const char* name, auto signal) {
        QPushButton* made = new QPushButton(text);
        made->setObjectName(QString::fromLatin1(name));
        connect(made, &QPushButton::clicked, this, [this, signal] {
            accept();
            (this->*signal)();
        });
        column->addWidget(made);
    };
    button(tr("Learn it in ten minutes"), "tutorial", &Welcome::tutorialWanted);
    button(tr("Empty scene"), "new", &Welcome::newWanted);
    button(tr("Template or generator…"), "template", &Welcome::templateWanted);
    button(tr("Open a file…"), "open", &Welcome::openWanted);
    const QStringList recent = settings.recentFiles().mid(0, recentShown);
    if (!recent.isEmpty()) {
        QLabel* title = new QLabel(tr("Opened last"));
        title->setProperty("role", QStringLiteral("muted"));
        column->addSpacing(10);
        column->addWidget(title);
    }
    for (const QString& path : recent) {
        QPushButton* file = new QPushButton(plainTitle(QFileInfo(path).fileName()));
        file->setFlat(true);
        file->setStyleSheet(QStringLiteral("text-align: left;"));
        file->setToolTip(plainTip(QDir::toNativeSeparators(path)));
        connect(file, &QPushButton::clicked, this, [this, path] {
            accept();
            Q_EMIT fileWanted(path);
        });
        column->addWidget(file);
    }
    column->addStretch(1);
    return side;
}

QListWidget* Welcome::gallery() {
    QListWidget* list = new QListWidget;
    list->setObjectName(QStringLiteral("gallery"));
    list->setAccessibleName(tr("Gallery of scenes"));
    list->setViewMode(QListView::IconMode);
    list->setResizeMode(QListView::Adjust);
    list->setMovement(QListView::Static);
    list->setIconSize(pictureSize);
    list->setSpacing(6);
    list->setWordWrap(true);
    for (const GalleryScene& scene : galleryScenes()) {
        QListWidgetItem* item = new QListWidgetItem(QIcon(scene.picture), titleOf(scene.name), list);
        item->setSizeHint(pictureSize + QSize(16, 36));
        item->setToolTip(headOf(scene.text));
        item->setData(Qt::UserRole, scene.text);
    }
    const auto choose = [this](const QListWidgetItem* item) {
        accept();
        Q_EMIT sceneWanted(item->data(Qt::UserRole).toString());
    };
    connect(list, &QListWidget::itemClicked, this, choose);
    connect(list, &QListWidget::itemActivated, this, [this, choose](const QListWidgetItem* item) {
        if (isVisible()) choose(item); // a click has chosen already
    });
    return list;
}

} // namespace carom

#include "moc_welcome.cpp"
