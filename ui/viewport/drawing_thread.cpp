// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/drawing_thread.h"

#include "core/base/clock.h"
#include "ui/viewport/renderer.h"

#include <QGuiApplication>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>

#include <utility>

namespace carom {

namespace {

/// Qt's offscreen platform says that they may, but its connection to the X server has no lock, as Xlib wants
/// it where several threads use one: they hang, or overwrite memory.
bool threadsMayDraw() {
    return QOpenGLContext::supportsThreadedOpenGL() &&
           QGuiApplication::platformName() != QStringLiteral("offscreen");
}

} // namespace

/// What lives in the drawing thread.
class DrawingThread::Worker : public QObject {
  public:
    Worker(DrawingThread& owner, QOffscreenSurface& surface) : m_owner(owner), m_surface(surface) {}

    void start();
    void stop();
    DrawnPicture draw(PictureJob job);
    bool hasGraphicsCard();

  private:
    QImage readBack() const;

    DrawingThread& m_owner;
    QOffscreenSurface& m_surface;
    std::unique_ptr<QOpenGLContext> m_context;
    std::unique_ptr<Renderer> m_renderer; ///< null where OpenGL does not work
    std::unique_ptr<QOpenGLFramebufferObject> m_target;
};

void DrawingThread::Worker::start() {
    if (m_context) return;
    m_context = std::make_unique<QOpenGLContext>();
    m_context->setFormat(m_surface.requestedFormat());
    m_renderer = std::make_unique<Renderer>();
    const bool current = m_context->create() && m_context->makeCurrent(&m_surface);
    // From the owner's thread, behind what it is doing now: whoever makes a DrawingThread has connected its
    // signals by then, however fast the worker was.
    const auto tell = [this](auto&& what) {
        QMetaObject::invokeMethod(&m_owner, std::forward<decltype(what)>(what), Qt::QueuedConnection);
    };
    if (!current || !m_renderer->initialise()) {
        const QString problem =
            current ? m_renderer->problem() : DrawingThread::tr("this display offers no OpenGL");
        tell([&owner = m_owner, problem] { Q_EMIT owner.failed(problem); });
        m_renderer.reset();
        return;
    }
    tell([&owner = m_owner, software = m_renderer->isSoftware()] { Q_EMIT owner.ready(software); });
}

void DrawingThread::Worker::stop() {
    // What is on the graphics card goes while its context is there.
    m_target.reset();
    m_renderer.reset();
    m_context.reset();
}

DrawnPicture DrawingThread::Worker::draw(PictureJob job) {
    const Stopwatch watch;
    QImage image;
    const QSize size = job.pixels();
    if (m_renderer && !size.isEmpty() && m_context->makeCurrent(&m_surface)) {
        if (!m_target || m_target->size() != size)
            m_target = std::make_unique<QOpenGLFramebufferObject>(
                size, QOpenGLFramebufferObject::CombinedDepthStencil);
        if (m_target->isValid() && m_target->bind()) {
            m_renderer->draw(job);
            image = readBack();
        }
    }
    return {std::move(job), std::move(image), watch.elapsed()};
}

bool DrawingThread::Worker::hasGraphicsCard() {
    start(); // may still stand in the queue where there is no second thread
    return m_renderer && !m_renderer->isSoftware();
}

QImage DrawingThread::Worker::readBack() const {
    QImage image(m_target->size(), QImage::Format_RGB32);
    if (image.isNull()) return image;
    m_context->functions()->glReadPixels(0, 0, image.width(), image.height(), GL_BGRA,
                                         GL_UNSIGNED_INT_8_8_8_8_REV, image.bits());
    image.mirror(); // OpenGL counts rows from below
    return image;
}

DrawingThread::DrawingThread(QObject* parent) : QObject(parent), m_worker(new Worker(*this, m_surface)) {
    m_surface.setFormat(Renderer::format());
    m_surface.create();
    // Where the display's OpenGL cannot be used by a second thread, the worker does its work in this one.
    if (threadsMayDraw()) {
        m_worker->moveToThread(&m_thread);
        m_thread.setObjectName(QStringLiteral("drawing"));
        m_thread.start();
    }
    QMetaObject::invokeMethod(
        m_worker, [worker = m_worker] { worker->start(); }, Qt::QueuedConnection);
}

DrawingThread::~DrawingThread() {
    wait([this] { m_worker->stop(); });
    m_thread.quit();
    m_thread.wait();
    delete m_worker;
}

void DrawingThread::post(PictureJob job) {
    QMetaObject::invokeMethod(
        m_worker, [this, job = std::move(job)]() mutable { Q_EMIT drawn(m_worker->draw(std::move(job))); },
        Qt::QueuedConnection);
}

QImage DrawingThread::draw(PictureJob job) {
    QImage image;
    wait([&] { image = m_worker->draw(std::move(job)).image; });
    return image;
}

bool DrawingThread::hasGraphicsCard() {
    bool has = false;
    wait([&] { has = m_worker->hasGraphicsCard(); });
    return has;
}

template<class Work>
void DrawingThread::wait(Work&& work) {
    const Qt::ConnectionType connection =
        m_worker->thread() == thread() ? Qt::DirectConnection : Qt::BlockingQueuedConnection;
    QMetaObject::invokeMethod(m_worker, std::forward<Work>(work), connection);
}

} // namespace carom

#include "moc_drawing_thread.cpp"
