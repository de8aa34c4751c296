// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gl_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace carom {

namespace {

/// Attribute locations, as in resources/shaders.
constexpr GLuint cornerAttribute = 0;
constexpr GLuint normalAttribute = 1;
constexpr GLuint copyAttribute = 2;
constexpr std::size_t mostVertices = 16384; ///< of all copies together; indices have 16 bits

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

void GlMesh::create(QOpenGLFunctions_3_3_Core& gl, const MeshData& data) {
    struct CopiedVertex {
        MeshVertex vertex;
        std::int32_t copy;
    };
    const std::size_t copies = std::max<std::size_t>(1, mostVertices / data.vertices.size());
    std::vector<CopiedVertex> vertices;
    std::vector<std::uint16_t> triangles;
    vertices.reserve(copies * data.vertices.size());
    triangles.reserve(copies * data.triangles.size());
    for (std::size_t copy = 0; copy < copies; ++copy) {
        for (const std::uint16_t corner : data.triangles)
            triangles.push_back(static_cast<std::uint16_t>(vertices.size() + corner));
        for (std::size_t i = 0; i < data.vertices.size();
             ++i) // triangles above count from the first of these
            vertices.push_back({data.vertices[i], static_cast<std::int32_t>(copy)});
    }
    m_copies = static_cast<int>(copies);
    m_indexCount = static_cast<int>(data.triangles.size());

    m_array.create();
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    m_vertices.create();
    m_vertices.bind();
    m_vertices.allocate(vertices.data(), static_cast<int>(vertices.size() * sizeof(CopiedVertex)));
    gl.glEnableVertexAttribArray(cornerAttribute);
    gl.glVertexAttribPointer(cornerAttribute, 3, GL_FLOAT, GL_FALSE, sizeof(CopiedVertex),
                             bufferOffset(offsetof(MeshVertex, position)));
    gl.glEnableVertexAttribArray(normalAttribute);
    gl.glVertexAttribPointer(normalAttribute, 3, GL_FLOAT, GL_FALSE, sizeof(CopiedVertex),
                             bufferOffset(offsetof(MeshVertex, normal)));
    gl.glEnableVertexAttribArray(copyAttribute);
    gl.glVertexAttribIPointer(copyAttribute, 1, GL_INT, sizeof(CopiedVertex),
                              bufferOffset(offsetof(CopiedVertex, copy)));
    m_triangles.create();
    m_triangles.bind();
    m_triangles.allocate(triangles.data(), static_cast<int>(triangles.size() * sizeof(std::uint16_t)));
}

void GlMesh::draw(QOpenGLFunctions_3_3_Core& gl, QOpenGLShaderProgram& program, InstanceRange range) {
    if (range.count == 0) return;
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    const int firstInstance = program.uniformLocation("firstInstance");
    for (int done = 0; done < range.count; done += m_copies) {
        program.setUniformValue(firstInstance, range.first + done);
        gl.glDrawElements(GL_TRIANGLES, m_indexCount * std::min(m_copies, range.count - done),
                          GL_UNSIGNED_SHORT, nullptr);
    }
}

} // namespace carom
