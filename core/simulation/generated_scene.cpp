// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/generated_scene.h"

#include "core/base/assert.h"
#include "core/generators/generator.h"
#include "core/language/analysis.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

namespace carom {
namespace {

/// Why the generator cannot be asked for so many.
std::optional<std::string> objectionTo(const GeneratorRow& row, const Generated& asked) {
    if (!asked.count) return std::nullopt;
    const std::string name = "`" + std::string(row.name) + "`", n = "`n` is " + std::to_string(*asked.count);
    if (row.defaultN == 0) return n + "; the number of bodies of " + name + " is fixed";
    const std::int64_t most = std::min<std::int64_t>(row.maximumN, mostGenerated);
    if (*asked.count >= row.minimumN && *asked.count <= most) return std::nullopt;
    return n + "; for " + name + " it must be from " + std::to_string(row.minimumN) + " to " +
           std::to_string(most);
}

/// Makes room for `count` bodies before number `first`.
void shift(Scene& scene, BodyIndex first, BodyIndex count) {
    const auto move = [&](BodyIndex& body) {
        if (body != noBody && body >= first) body += count;
    };
    for (Spring& spring : scene.springs) {
        move(spring.from);
        move(spring.to);
    }
    std::map<std::shared_ptr<const std::vector<BodyIndex>>, std::shared_ptr<const std::vector<BodyIndex>>>
        families; // many expectations share one
    for (Expectation& expectation : scene.expectations) {
        move(expectation.of);
        move(expectation.to);
        if (!expectation.ofEach) continue;
        std::shared_ptr<const std::vector<BodyIndex>>& moved = families[expectation.ofEach.bodies];
        if (moved == nullptr) {
            std::vector<BodyIndex> bodies = *expectation.ofEach.bodies;
            std::ranges::for_each(bodies, move);
            moved = std::make_shared<const std::vector<BodyIndex>>(std::move(bodies));
        }
        expectation.ofEach.bodies = moved;
    }
}

/// Everything that has a place in the world.
void move(Scene& scene, const Vec3& offset) {
    for (Body& body : scene.bodies) {
        if (Wall* wall = std::get_if<Wall>(&body.shape))
            wall->offset += wall->normal.dot(offset);
        else
            body.pose.position += offset;
    }
    for (Spring& spring : scene.springs) {
        if (spring.from == noBody) spring.fromAt += offset;
        if (spring.to == noBody) spring.toAt += offset;
    }
    for (std::optional<Vec3>* place : {&scene.camera.position, &scene.camera.target})
        if (*place) **place += offset;
}

/// Inserts `made`, all from one declaration, in the order of the text.
template<class Thing>
std::size_t insertInOrder(std::vector<Thing>& things, std::vector<Thing> made,
                          const DeclarationSource& source) {
    const auto place = std::ranges::find_if(things, [&](const Thing& thing) {
        return thing.source.declaration.offset > source.declaration.offset;
    });
    const auto first = static_cast<std::size_t>(place - things.begin());
    things.insert(place, std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
    return first;
}

/// By expectation: whether it is of the bodies that are to be made.
std::vector<bool> askedOfMade(const Scene& scene) {
    const auto& made = scene.generated->bodies.bodies;
    std::vector<bool> asked;
    for (const Expectation& expectation : scene.expectations)
        asked.push_back(made != nullptr && expectation.ofEach.bodies == made);
    return asked;
}

/// The family of the declaration's label, now that its bodies are there.
void name(Scene& scene, const std::vector<bool>& asked, BodyIndex first, BodyIndex count) {
    std::vector<BodyIndex> mobile;
    for (BodyIndex i = first; i < first + count; ++i)
        if (scene.bodies[i].mobile()) mobile.push_back(i);
    const auto family = std::make_shared<const std::vector<BodyIndex>>(std::move(mobile));
    if (scene.generated->bodies) scene.generated->bodies.bodies = family;
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (asked[i]) scene.expectations[i].ofEach.bodies = family;
}

/// What the text does not say itself. Without a source: what edits the text must not look for it there.
void takeSurroundings(Scene& scene, const Scene& made) {
    if (!scene.gravity.source) scene.gravity.acceleration = made.gravity.acceleration;
    if (!scene.camera.source) {
        scene.camera = made.camera;
        scene.camera.source.reset();
    }
    std::optional<DeclarationSource> own = scene.simulation.source;
    scene.simulation = overridden(made.simulation, scene.simulation);
    scene.simulation.source = std::move(own);
}

} // namespace

std::optional<Diagnostic> addGenerated(Scene& scene, std::optional<int> seed, const WorkStage& stage) {
    if (!scene.generated) return std::nullopt;
    const Generated& asked = *scene.generated;
    const GeneratorRow* row = findGenerator(asked.generator);
    ASSERT(row != nullptr && asked.source); // the schema's words are the catalogue's
    if (std::optional<std::string> objection = objectionTo(*row, asked)) {
        const ParameterSource* n = scene.find(*asked.source, "n");
        Diagnostic diagnostic;
        diagnostic.code = DiagnosticCode::ValueOutOfRange;
        diagnostic.range = n != nullptr ? n->value : asked.source->type;
        diagnostic.message = *objection;
        return diagnostic;
    }
    const auto number = static_cast<std::uint64_t>(seed.value_or(asked.seed));
    Scene made = analyse(generate(*row, {.n = asked.count, .seed = number, .options = {}}), stage).scene;
    move(made, asked.offset);
    DeclarationSource source = *asked.source;
    source.label = {};
    for (Body& body : made.bodies) {
        body.label.clear();
        body.source = source;
    }
    const auto count = static_cast<BodyIndex>(made.bodies.size());
    std::vector<Spring> springs = std::move(made.springs);
    const std::size_t first = insertInOrder(scene.bodies, std::move(made.bodies), source);
    const auto offset = static_cast<BodyIndex>(first);
    const std::vector<bool> ofMade = askedOfMade(scene);
    shift(scene, offset, count);
    name(scene, ofMade, offset, count);
    for (Spring& spring : springs) {
        for (BodyIndex* end : {&spring.from, &spring.to})
            if (*end != noBody) *end += offset;
        spring.source = source;
    }
    insertInOrder(scene.springs, std::move(springs), source);
    takeSurroundings(scene, made);
    return std::nullopt;
}

} // namespace carom
