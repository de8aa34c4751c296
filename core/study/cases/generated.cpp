// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/cases/generated.h"

namespace carom {

std::string generated(std::string_view name, const GeneratorRequest& request) {
    std::string scene = generate(*findGenerator(name), request);
    if (const std::size_t begin = scene.find("\nsimulation {"); begin != scene.npos)
        scene.erase(begin, scene.find('}', begin) + 1 - begin);
    return scene;
}

} // namespace carom
