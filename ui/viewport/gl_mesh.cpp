// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gl_mesh.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace carom {

namespace {

/// Attribute locations, as in resources/shaders.
constexpr GLuint cornerAttribute = 0;
constexpr GLuint normalAttribute = 1;
constexpr GLuint firstInstanceAttribute = 2;
constexpr GLuint instanceAttributes = 4; ///< four vectors of four floats an instance

const void* bufferOffset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

void addTriangles(MeshData& mesh, std::initializer_list<int> corners, std::size_t first) {
    for (const int corner : corners)
        mesh.triangles.push_back(static_cast<std::uint16_t>(first + static_cast<std::size_t>(corner)));
}

} // namespace

MeshData squareMesh() {
    MeshData mesh;
    for (const float y : {-1.0F, 1.0F})
        for (const float x : {-1.0F, 1.0F}) mesh.vertices.push_back({{x, y, 0}, {0, 0, 1}});
    addTriangles(mesh, {0, 1, 3, 0, 3, 2}, 0);
    return mesh;
}

MeshData cubeMesh() {
    MeshData mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            const std::size_t first = mesh.vertices.size();
            // Seen from outside x and y go right and up; on the negative sides x runs the other way.
            for (const float y : {-1.0F, 1.0F}) {
                for (const float x : {-1.0F, 1.0F}) {
                    MeshVertex vertex{};
                    vertex.position[axis] = vertex.normal[axis] = side;
                    vertex.position[(axis + 1) % 3] = x * side;
                    vertex.position[(axis + 2) % 3] = y;
                    mesh.vertices.push_back(vertex);
                }
            }
            addTriangles(mesh, {0, 1, 3, 0, 3, 2}, first);
        }
    }
    return mesh;
}

MeshData cylinderMesh(int segments) {
    MeshData mesh;
    const auto around = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / segments;
        return std::pair{static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle))};
    };
    for (int i = 0; i <= segments; ++i) {
        const std::size_t first = mesh.vertices.size();
        const auto [x, z] = around(i % segments);
        mesh.vertices.push_back({{x, -1, z}, {x, 0, z}});
        mesh.vertices.push_back({{x, 1, z}, {x, 0, z}});
        if (i < segments) addTriangles(mesh, {0, 2, 3, 0, 3, 1}, first);
    }
    for (const float side : {-1.0F, 1.0F}) {
        const std::size_t centre = mesh.vertices.size();
        mesh.vertices.push_back({{0, side, 0}, {0, side, 0}});
        for (int i = 0; i <= segments; ++i) {
            const auto [x, z] = around(i % segments);
            mesh.vertices.push_back({{x, side, z}, {0, side, 0}});
            if (i == segments) continue;
            if (side > 0)
                addTriangles(mesh, {0, i + 1, i + 2}, centre);
            else
                addTriangles(mesh, {0, i + 2, i + 1}, centre);
        }
    }
    return mesh;
}

void GlMesh::create(QOpenGLFunctions_3_3_Core& gl, const MeshData& data, QOpenGLBuffer& instances) {
    m_array.create();
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    m_vertices.create();
    m_vertices.bind();
    m_vertices.allocate(data.vertices.data(), static_cast<int>(data.vertices.size() * sizeof(MeshVertex)));
    gl.glEnableVertexAttribArray(cornerAttribute);
    gl.glVertexAttribPointer(cornerAttribute, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                             bufferOffset(offsetof(MeshVertex, position)));
    gl.glEnableVertexAttribArray(normalAttribute);
    gl.glVertexAttribPointer(normalAttribute, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                             bufferOffset(offsetof(MeshVertex, normal)));
    m_triangles.create();
    m_triangles.bind();
    m_triangles.allocate(data.triangles.data(),
                         static_cast<int>(data.triangles.size() * sizeof(std::uint16_t)));
    m_indexCount = static_cast<int>(data.triangles.size());

    instances.bind();
    for (GLuint i = 0; i < instanceAttributes; ++i) {
        gl.glEnableVertexAttribArray(firstInstanceAttribute + i);
        gl.glVertexAttribDivisor(firstInstanceAttribute + i, 1);
    }
}

void GlMesh::draw(QOpenGLFunctions_3_3_Core& gl, QOpenGLBuffer& instances, InstanceRange range) {
    if (range.count == 0) return;
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    // OpenGL 3.3 has no first instance in its draw calls: the attributes start at the range instead.
    instances.bind();
    const std::size_t start = static_cast<std::size_t>(range.first) * sizeof(Instance);
    for (GLuint i = 0; i < instanceAttributes; ++i)
        gl.glVertexAttribPointer(firstInstanceAttribute + i, 4, GL_FLOAT, GL_FALSE, sizeof(Instance),
                                 bufferOffset(start + i * 4 * sizeof(float)));
    gl.glDrawElementsInstanced(GL_TRIANGLES, m_indexCount, GL_UNSIGNED_SHORT, nullptr, range.count);
}

} // namespace carom
