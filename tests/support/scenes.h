// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/scene/scene.h"
#include "core/simulation/world.h"

#include <QByteArray>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QString>
#include <QStringList>

#include <memory>

// A small vocabulary for tests of motion: scenes without a text, and the shipped ones.

namespace carom::test {

inline Body sphere(double radius, double mass, const Vec3& centre, const Vec3& velocity = Vec3::Zero()) {
    Body body;
    body.shape = Sphere{radius};
    body.mass = mass;
    body.pose.position = centre;
    body.velocity = velocity;
    return body;
}

/// A cylinder along y.
inline Body cylinder(double radius, double height, double mass, const Vec3& centre) {
    Body body;
    body.shape = Cylinder{radius, height / 2};
    body.mass = mass;
    body.pose.position = centre;
    return body;
}

inline Body cuboid(const Vec3& size, double mass, const Vec3& centre) {
    Body body;
    body.shape = Cuboid{size / 2};
    body.mass = mass;
    body.pose.position = centre;
    return body;
}

/// The surface is { x : normal·x = offset }; `normal` is a unit vector.
inline Body wall(const Vec3& normal, double offset) {
    Body body;
    body.shape = Wall{normal, offset};
    body.fixed = true;
    return body;
}

inline Scene sceneOf(std::initializer_list<Body> bodies, const Vec3& gravity = Vec3::Zero()) {
    Scene scene;
    scene.bodies = bodies;
    scene.gravity.acceleration = gravity;
    return scene;
}

/// Options that name the method and leave the rest to the scene.
inline SimulationSettings byMethod(const char* name) {
    SimulationSettings options;
    options.method = name;
    return options;
}

/// What tests hold of scenes they hold of the general method, unless they name another.
inline World worldOf(const Scene& scene, const SimulationSettings& options = byMethod("contacts")) {
    return World(std::make_shared<const Pipeline>(scene, options));
}

inline void run(World& world, int frames) {
    for (int i = 0; i < frames; ++i) world.step();
}

/// The scenes that ship with the program, by path from the scenes folder, ascending.
inline QStringList shippedScenes() {
    const QDir folder(QStringLiteral(CAROM_SOURCE_DIR "/scenes"));
    QStringList paths;
    QDirIterator files(folder.path(), {QStringLiteral("*.sdl")}, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) paths += folder.relativeFilePath(files.next());
    paths.sort();
    return paths;
}

inline std::string textOfScene(const QString& path) {
    QFile file(QStringLiteral(CAROM_SOURCE_DIR "/scenes/") + path);
    if (!file.open(QIODevice::ReadOnly)) return {};
    return file.readAll().toStdString();
}

} // namespace carom::test
