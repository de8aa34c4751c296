// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/overlay_tips.h"

#include <QCoreApplication>

#include <cmath>

namespace carom {
namespace {

/// [px] around an arrow; at half it is hard to hit, at twice arrows hide each other.
constexpr double tipReach = 8;
constexpr int tipDigits = 4; ///< significant

QString words(const char* text) { return QCoreApplication::translate("carom::OverlayTip", text); }

QString figure(double value) { return QString::number(value, 'g', tipDigits); }

QString nameOf(const Scene& scene, BodyIndex body) {
    const std::string& label = scene.bodies[body].label;
    return QString::fromStdString(label.empty() ? scene.nameOf(body) : label);
}

QString tellContact(const TipRequest& request, const ContactForce& contact) {
    const double pressing = contact.force.dot(contact.normal);
    const double along = (contact.force - pressing * contact.normal).norm();
    QString text = words(QT_TRANSLATE_NOOP("carom::OverlayTip", "%1 and %2"))
                       .arg(nameOf(request.scene, contact.pair.a), nameOf(request.scene, contact.pair.b));
    text += u'\n' + words(QT_TRANSLATE_NOOP("carom::OverlayTip", "force %1 N, impulse %2 N s a frame"))
                        .arg(figure(contact.force.norm()), figure(contact.force.norm() * request.frame));
    if (!(contact.friction > 0))
        return text + u'\n' + words(QT_TRANSLATE_NOOP("carom::OverlayTip", "no friction"));
    const char* state = contact.slides()
                            ? QT_TRANSLATE_NOOP("carom::OverlayTip", "slides; friction %1 N of %2 N")
                            : QT_TRANSLATE_NOOP("carom::OverlayTip", "sticks; friction %1 N of %2 N");
    return text + u'\n' + words(state).arg(figure(along), figure(contact.friction * pressing));
}

} // namespace

QString tipAt(const TipRequest& request, const Camera& camera, const PictureSize& picture,
              const Eigen::Vector2d& pixel) {
    QString told;
    double least = tipReach;
    const auto nearer = [&](const Vec3& point) {
        const std::optional<Eigen::Vector2d> at = projected(camera, picture, point);
        if (!at || !((*at - pixel).norm() < least)) return false;
        least = (*at - pixel).norm();
        return true;
    };
    if (holds(request.overlays, Overlay::Contacts)) {
        const ContactForce* nearest = nullptr;
        for (const ContactForce& contact : request.snapshot.contactForces)
            if (!contact.normal.isZero() && nearer(contact.at)) nearest = &contact;
        if (nearest != nullptr) told = tellContact(request, *nearest);
    }
    if (holds(request.overlays, Overlay::Velocities))
        for (std::size_t i = 0; i < request.snapshot.velocity.size(); ++i) {
            const Vec3& velocity = request.snapshot.velocity[i];
            if (velocity.isZero() ||
                !nearer(request.snapshot.pose[i].position + request.arrowTime * velocity))
                continue;
            told = words(QT_TRANSLATE_NOOP("carom::OverlayTip", "%1: %2 m/s"))
                       .arg(nameOf(request.scene, static_cast<BodyIndex>(i)), figure(velocity.norm()));
        }
    return told;
}

} // namespace carom
