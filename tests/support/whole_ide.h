// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/ide.h"
#include "tests/support/kept_window.h"

#include "ui/docks/problems_dock.h"
#include "ui/viewport/viewport.h"

#include <QAbstractItemView>

// A scene of two balls in the whole IDE, on the screen.

namespace carom::test {

inline const QByteArray twoBalls = "camera { position 0,1,6 target 0,1,0 fov 40 }\n"
                                   "wall { normal 0,1,0 toOrig 0 }\n"
                                   "sphere left { radius .5 mass 1 centre -1,1,0 vel 0,3,0 colour red }\n"
                                   "sphere right { radius .5 mass 1 centre 1,1,0 colour blue }\n";

/// The whole IDE with the two balls in it, on the screen: as new, but the window may have been used by a test
/// before (kept_window.h). A window of its own gets who finds settings, which are read when it is made.
struct Ide {
    QTemporaryDir folder;
    QString path = folder.filePath(QStringLiteral("balls.sdl"));
    std::unique_ptr<Workbench> owned;
    bool kept;
    Workbench& bench = *owned;
    SceneEditor& editor = bench.window().editor();
    Viewport& viewport = bench.window().viewport();
    Simulation& simulation = bench.simulation();
    std::int64_t frame = -1;
    std::unique_ptr<QObject> scope = std::make_unique<QObject>(); ///< of what the test connects to the window

    explicit Ide(const QByteArray& text = twoBalls) : Ide(text, QSettings().allKeys().isEmpty()) {}
    ~Ide() {
        scope.reset();
        editor.markSaved();
        if (kept && !QTest::currentTestFailed()) KeptWindow::giveBack(std::move(owned));
    }
    Ide(const Ide&) = delete;
    Ide& operator=(const Ide&) = delete;

    void trigger(ActionId id) { bench.window().actions()[id].trigger(); }
    int problems() { return bench.window().problems().findChild<QAbstractItemView*>()->model()->rowCount(); }
    bool current() const { return bench.builds().isCurrent(); }
    QColor pixel(double x, double y) {
        const QImage picture = viewport.shownPicture();
        return picture.pixelColor(static_cast<int>(x * picture.width()),
                                  static_cast<int>(y * picture.height()));
    }
    QPoint place(double x, double y) const {
        return {static_cast<int>(x * viewport.width()), static_cast<int>(y * viewport.height())};
    }
    /// Where a body is on screen: the first hit on a coarse raster.
    QPoint placeOf(BodyIndex body) const {
        for (int y = 4; y < viewport.height(); y += 8)
            for (int x = 4; x < viewport.width(); x += 8)
                if (viewport.hitAt(QPointF(x, y)).body == body) return {x, y};
        return {-1, -1};
    }

  protected:
    Ide(const QByteArray& text, bool mayBeKept)
        : owned(mayBeKept ? KeptWindow::take() : KeptWindow::makeWindow()), kept(mayBeKept) {
        QObject::connect(&simulation, &Simulation::snapshotArrived, scope.get(),
                         [this](const std::shared_ptr<const Snapshot>& s) { frame = s->frame; });
        writeFile(path, text);
        if (bench.document().open(path)) qFatal("the test's scene cannot be opened");
        bench.window().activateWindow();
        if (!QTest::qWaitForWindowActive(&bench.window(), longestWait)) qFatal("the window is not active");
        editor.viewport()->repaint(); // nobody uses a text that is not on the screen yet
    }
};

/// One with a window of its own, for tests of how a window begins and ends.
struct NewIde : Ide {
    explicit NewIde(const QByteArray& text = twoBalls) : Ide(text, false) {}
};

inline void typeAtTheEnd(SceneEditor& editor, const char* text) {
    editor.send(QsciScintillaBase::SCI_GOTOPOS, editor.bytes().size());
    QTest::keyClicks(&editor, QString::fromLatin1(text));
}

} // namespace carom::test
