// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/opengl_screen.h"

#include "core/base/clock.h"
#include "ui/viewport/renderer.h"

#include <QOpenGLContext>
#include <QPainter>

#include <cmath>
#include <utility>

namespace carom {

OpenGLScreen::OpenGLScreen(Painter overPicture, QWidget* parent)
    : QOpenGLWidget(parent), m_overPicture(std::move(overPicture)) {
    setFormat(Renderer::format());
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
}

OpenGLScreen::~OpenGLScreen() {
    // The context ends with the base class, when this is no OpenGLScreen any more.
    if (context() != nullptr)
        disconnect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &OpenGLScreen::dropRenderer);
    dropRenderer();
}

/// What is on the graphics card goes while its context is there.
void OpenGLScreen::dropRenderer() {
    if (!m_renderer) return;
    makeCurrent();
    m_renderer.reset();
    doneCurrent();
}

void OpenGLScreen::post(PictureJob job) {
    m_job = std::move(job);
    m_due = true;
    update();
}

// Once more when the widget has come into another window.
void OpenGLScreen::initializeGL() {
    connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &OpenGLScreen::dropRenderer,
            Qt::UniqueConnection);
    m_renderer = std::make_unique<Renderer>();
    if (m_renderer->initialise()) return;
    Q_EMIT failed(m_renderer->problem());
    m_renderer.reset();
}

void OpenGLScreen::paintGL() {
    if (!m_renderer || !m_job.stage) return;
    const Stopwatch watch;
    // After a change of size the last picture is drawn anew until the next has come.
    m_job.options.size = {std::round(width() * devicePixelRatioF()),
                          std::round(height() * devicePixelRatioF())};
    m_renderer->draw(m_job);
    m_renderer->finish();
    const double milliseconds = watch.elapsed();
    QPainter painter(this);
    m_overPicture(painter, m_job);
    painter.end();
    if (std::exchange(m_due, false)) Q_EMIT drawn({m_job, {}, milliseconds});
}

} // namespace carom

#include "moc_opengl_screen.cpp"
