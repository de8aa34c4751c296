// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/generators/scene_writer.h"

#include <algorithm>
#include <cmath>

namespace carom {
namespace {

constexpr std::size_t longestLine = 110; ///< the formatter's; a longer declaration gets a line a parameter

} // namespace

double rounded(double value, double perUnit) {
    const double result = std::round(value * perUnit) / perUnit;
    return result == 0 ? 0.0 : result;
}

Vec3 rounded(const Vec3& value, double perUnit) {
    return {rounded(value.x(), perUnit), rounded(value.y(), perUnit), rounded(value.z(), perUnit)};
}

void SceneWriter::comment(std::string_view text) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        m_text += end > begin ? "// " : "//";
        m_text += text.substr(begin, end - begin);
        m_text += '\n';
        begin = end + 1;
    }
}

void SceneWriter::gravity(const Vec3& acceleration) {
    open("gravity");
    parameter("accel", acceleration);
    close();
}

void SceneWriter::substeps(int count) {
    open("simulation");
    parameter("substeps", count);
    close();
}

void SceneWriter::camera(const Vec3& position, const Vec3& target, double fieldOfView) {
    open("camera");
    parameter("position", position);
    parameter("target", target);
    parameter("fov", fieldOfView);
    close();
}

void SceneWriter::wall(const Vec3& normal, double toOrigin, double elastic, std::string_view colour,
                       double friction) {
    open("wall");
    parameter("normal", normal);
    parameter("toOrig", toOrigin);
    if (elastic != 1) parameter("elastic", elastic);
    if (friction != 0) parameter("friction", friction);
    parameter("colour", colour);
    close();
}

void SceneWriter::openBox(double half, double elastic, double friction) {
    wall(Vec3::UnitY(), 0, elastic, "gray", friction);
    for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
        wall(side, half, elastic, "silver", friction);
}

void SceneWriter::sphere(double radius, const WrittenBody& body) {
    open("sphere", body.label);
    parameter("radius", radius);
    common(body);
    close();
}

void SceneWriter::cylinder(double radius, double height, const Vec3& axis, const Vec3& spin,
                           const WrittenBody& body) {
    open("cylinder", body.label);
    parameter("radius", radius);
    parameter("height", height);
    parameter("axis", axis);
    if (spin != Vec3::Zero()) parameter("angvel", spin);
    common(body);
    close();
}

void SceneWriter::cuboid(const Vec3& size, const Vec3& rotation, const WrittenBody& body) {
    open("cuboid", body.label);
    parameter("size", size);
    if (rotation != Vec3::Zero()) parameter("rotation", rotation);
    common(body);
    close();
}

void SceneWriter::spring(const WrittenSpring& spring) {
    open("spring");
    parameter("from", spring.from);
    parameter("to", spring.to);
    if (spring.fromAt != Vec3::Zero()) parameter("fromAt", spring.fromAt);
    parameter("stiffness", spring.stiffness);
    if (spring.damping != 0) parameter("damping", spring.damping);
    if (spring.length) parameter("length", *spring.length);
    close();
}

void SceneWriter::common(const WrittenBody& body) {
    if (body.fixed)
        parameter("fixed", "yes");
    else
        parameter("mass", body.mass);
    parameter("centre", body.centre);
    if (body.velocity != Vec3::Zero()) parameter("vel", body.velocity);
    if (body.elastic != 1) parameter("elastic", body.elastic);
    if (body.friction != 0) parameter("friction", body.friction);
    if (body.colour != "white") parameter("colour", body.colour);
}

void SceneWriter::open(std::string_view type, std::string_view label) {
    m_head = type;
    if (!label.empty()) m_head.append(" ").append(label);
    m_parameters.clear();
}

void SceneWriter::parameter(std::string_view name, double value) { parameter(name, shortest(value)); }

void SceneWriter::parameter(std::string_view name, const Vec3& value) {
    const Vec3 positiveZeros = value + Vec3::Zero(); // -0 + 0 = 0
    std::string text = shortest(positiveZeros.x());
    for (Eigen::Index k = 1; k < 3; ++k) text += ", " + shortest(positiveZeros[k]);
    parameter(name, text);
}

void SceneWriter::parameter(std::string_view name, std::string_view word) {
    m_parameters.emplace_back(name).append(" ").append(word);
}

void SceneWriter::close() {
    std::string line = m_head + " {";
    for (const std::string& parameter : m_parameters)
        line.append(&parameter == &m_parameters.front() ? " " : "  ").append(parameter);
    line += " }";
    if (m_spreadOut || line.size() > longestLine) {
        line = m_head + " {\n";
        for (const std::string& parameter : m_parameters) line.append("    ").append(parameter).append("\n");
        line += "}";
    }
    m_text += line + "\n";
}

} // namespace carom
