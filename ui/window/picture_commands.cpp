// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/picture_commands.h"

#include "ui/base/file_output.h"
#include "ui/editor/live_build.h"
#include "ui/editor/scene_editor.h"
#include "ui/player/simulation.h"
#include "ui/viewport/video.h"
#include "ui/viewport/viewport.h"
#include "ui/base/save_dialog.h"
#include "ui/base/actions.h"
#include "ui/window/live_preview.h"
#include "ui/window/main_window.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QElapsedTimer>
#include <QFormLayout>
#include <QImage>
#include <QProgressDialog>
#include <QSpinBox>

#include <array>
#include <cmath>
#include <numbers>

namespace carom {
namespace {

constexpr int largestSide = 8192; // [px] of a picture: the limit of common OpenGL 3.3 drivers

QSpinBox* pixels(const char* name, int value) {
    QSpinBox* box = new QSpinBox;
    box->setObjectName(QLatin1StringView(name));
    box->setRange(16, largestSide);
    box->setSingleStep(2);
    box->setSuffix(QStringLiteral(" px"));
    box->setValue(value);
    return box;
}

QDoubleSpinBox* number(const char* name, double value, double most, const QString& suffix) {
    QDoubleSpinBox* box = new QDoubleSpinBox;
    box->setObjectName(QLatin1StringView(name));
    box->setRange(0, most);
    box->setDecimals(3);
    box->setSuffix(suffix);
    box->setValue(value);
    return box;
}

/// A form with OK and Cancel; true for OK.
bool accepted(QDialog& dialog, QFormLayout& form) {
    QDialogButtonBox* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    QObject::connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
    QObject::connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
    form.addRow(buttons);
    return dialog.exec() == QDialog::Accepted;
}

/// A length or angle as one would write it: four digits tell views apart.
QByteArray written(double value) {
    const double rounded = QString::number(value, 'g', 4).toDouble();
    return QByteArray::number(rounded == 0 ? 0 : rounded, 'g', 4);
}

QByteArray written(const Vec3& v) { return written(v.x()) + "," + written(v.y()) + "," + written(v.z()); }

} // namespace

PictureCommands::PictureCommands(MainWindow& window, Simulation& simulation, const LiveBuild& builds,
                                 const LivePreview& preview)
    : QObject(&window), m_window(window), m_simulation(simulation), m_builds(builds), m_preview(preview) {
    const Actions& actions = window.actions();
    connect(&actions[ActionId::SaveView], &QAction::triggered, this, &PictureCommands::savePicture);
    connect(&actions[ActionId::RecordVideo], &QAction::triggered, this, &PictureCommands::askForVideo);
    connect(&actions[ActionId::CopyCamera], &QAction::triggered, this, &PictureCommands::copyCamera);
}

void PictureCommands::savePicture() {
    QDialog dialog(&m_window);
    dialog.setWindowTitle(tr("Save the view"));
    QFormLayout form(&dialog);
    const double scale = m_window.viewport().devicePixelRatioF();
    QSpinBox* width = pixels("pictureWidth", static_cast<int>(m_window.viewport().width() * scale));
    QSpinBox* height = pixels("pictureHeight", static_cast<int>(m_window.viewport().height() * scale));
    form.addRow(tr("Width"), width);
    form.addRow(tr("Height"), height);
    if (!accepted(dialog, form)) return;
    const QString path =
        askWhereToSave(&m_window, tr("Save the view"), QStringLiteral("view.png"), tr("Pictures (*.png)"));
    if (path.isEmpty()) return;
    const QString problem = saveImage(path, m_window.viewport().picture({width->value(), height->value()}));
    Q_EMIT reported(problem.isEmpty() ? tr("saved %1").arg(path) : problem);
}

void PictureCommands::askForVideo() {
    QDialog dialog(&m_window);
    dialog.setWindowTitle(tr("Record a video"));
    QFormLayout form(&dialog);
    QSpinBox* width = pixels("videoWidth", 960);
    QSpinBox* height = pixels("videoHeight", 720);
    QDoubleSpinBox* from = number("videoFrom", 0, 1e6, tr(" s"));
    QDoubleSpinBox* to = number("videoTo", std::max(2.0, m_simulation.time()), 1e6, tr(" s"));
    QDoubleSpinBox* rate = number("videoRate", 30, 100, tr(" pictures a second"));
    QDoubleSpinBox* speed = number("videoSpeed", 1, 100, tr(" × real time"));
    rate->setMinimum(1);
    speed->setMinimum(0.01);
    form.addRow(tr("Width"), width);
    form.addRow(tr("Height"), height);
    form.addRow(tr("From"), from);
    form.addRow(tr("To"), to);
    form.addRow(tr("Rate"), rate);
    form.addRow(tr("Speed"), speed);
    if (!accepted(dialog, form)) return;
    const auto even = [](const QSpinBox* box) { return box->value() / 2 * 2; };
    const Viewport& viewport = m_window.viewport();
    VideoPlan plan{.look = viewport.view({even(width), even(height)}),
                   .overlays = viewport.overlays(),
                   .from = from->value(),
                   .to = to->value(),
                   .rate = rate->value(),
                   .speed = speed->value(),
                   .size = {even(width), even(height)},
                   .path = {}};
    plan.path = askWhereToSave(
        &m_window, tr("Record a video"), QStringLiteral("run.gif"),
        tr("Animated pictures (*.gif);;Videos (*.mp4);;One picture a frame (*.png)"),
        [pictures = plan.pictures()](const QString& path) { return replacedBy(path, pictures); });
    if (!plan.path.isEmpty()) video(plan);
}

void PictureCommands::video(const VideoPlan& plan) {
    Video* video = new Video(plan, this);
    QProgressDialog* progress =
        new QProgressDialog(tr("Recording…"), tr("Cancel"), 0, plan.pictures(), &m_window);
    progress->setObjectName(QStringLiteral("videoProgress"));
    progress->setWindowTitle(tr("Record a video"));
    progress->setMinimumDuration(500);
    progress->setAutoReset(false);
    connect(progress, &QProgressDialog::canceled, video, &Video::cancel);
    QElapsedTimer since;
    since.start();
    connect(video, &Video::progressed, progress, [progress, since, all = plan.pictures()](int pictures) {
        if (progress->wasCanceled()) return;
        progress->setValue(pictures);
        const double left =
            1e-3 * static_cast<double>(since.elapsed()) / pictures * static_cast<double>(all - pictures);
        progress->setLabelText(tr("Picture %1 of %2, %3 s left").arg(pictures).arg(all).arg(std::ceil(left)));
    });
    connect(video, &Video::encoding, progress, [progress] {
        progress->setLabelText(tr("Putting the pictures together…"));
        progress->setMaximum(0); // nobody knows how long it takes
    });
    connect(video, &Video::finished, this, [this, video, progress, path = plan.path](const QString& problem) {
        Q_EMIT reported(problem.isEmpty() ? tr("recorded %1").arg(path)
                                          : tr("not recorded: %1").arg(problem));
        progress->deleteLater();
        video->deleteLater();
    });
    video->start();
}

void PictureCommands::copyCamera() {
    if (!m_builds.isCurrent()) return;
    const Camera& camera = m_window.viewport().camera();
    const QByteArray text = "camera { position " + written(camera.eye()) + " target " +
                            written(camera.target) + " fov " +
                            written(camera.fieldOfView * 180 / std::numbers::pi) + " }";
    const std::optional<DeclarationSource>& declared = m_builds.latest()->scene().camera.source;
    if (declared)
        m_window.editor().replaceRange(declared->declaration, text);
    else
        m_window.editor().replaceRange({0, 0}, m_window.editor().withLineEnds(text + "\n"));
    Q_EMIT reported(tr("the camera is in the scene now"));
}

} // namespace carom

#include "moc_picture_commands.cpp"
