// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/random.h"
#include "core/scene/schema.h"
#include "tests/fuzz/properties.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

// Takes right scenes apart: bytes are changed, pieces moved, doubled, cut and exchanged, tokens of the
// language strewn in. Deterministic: the k-th text depends on the seed and k alone, so a failure is repeated
// by its number.
//
//     analyse_fuzz [COUNT [SEED [FIRST]]]
//
// Or takes texts that libFuzzer found, each of which reaches something that no other does (corpus.txt): a
// line a text, with what is not printable, and `%`, as %XX.
//
//     analyse_fuzz --corpus FILE

namespace {

using carom::Random;

constexpr std::array<std::string_view, 44> fragments = {"{",
                                                        "}",
                                                        ";",
                                                        ":",
                                                        ",",
                                                        "-",
                                                        ".",
                                                        "//",
                                                        "#",
                                                        "\n",
                                                        "\r",
                                                        "\r\n",
                                                        " ",
                                                        "\t",
                                                        "1",
                                                        "0",
                                                        "-1",
                                                        "1e999",
                                                        "1e-3",
                                                        ".5",
                                                        "5.",
                                                        "1.2.3",
                                                        "1e",
                                                        "0, 0, 0",
                                                        "1, 2",
                                                        "1, 2, 3, 4",
                                                        "sphere",
                                                        "wall",
                                                        "\nwall",
                                                        "spring",
                                                        "world",
                                                        "radius",
                                                        "mass",
                                                        "centre",
                                                        "colour",
                                                        "red",
                                                        "fixed yes",
                                                        "/*",
                                                        "*/",
                                                        "@",
                                                        "_",
                                                        "\xC3\xB6",
                                                        "\xEF\xBB\xBF",
                                                        "\xFF"};

std::string seedText(Random& random) {
    std::string text;
    const std::span<const carom::DeclarationRow> rows = carom::schema();
    for (std::uint64_t count = 1 + random.below(4); count > 0; --count) {
        const carom::DeclarationRow& row = rows[random.below(rows.size())];
        text += row.example;
        text += random.below(2) == 0 ? "\n" : " // comment\n";
        if (random.below(3) == 0) continue;
        text += std::string(row.name) + " l" + std::to_string(random.below(4)) + " {\n";
        for (const carom::ParameterRow& parameter : row.parameters)
            if (parameter.required || random.below(3) == 0)
                text += "  " + std::string(parameter.name) + " " + std::string(parameter.example) + "\n";
        text += "}\n";
    }
    return text;
}

void mutate(std::string& text, Random& random) {
    const auto place = [&] { return static_cast<std::size_t>(random.below(text.size() + 1)); };
    const auto length = [&] { return static_cast<std::size_t>(random.below(12)); };
    const std::size_t at = place();
    switch (random.below(6)) {
    case 0:
        text.insert(at, fragments[random.below(fragments.size())]);
        break;
    case 1:
        text.erase(at, length());
        break;
    case 2:
        if (at < text.size()) text[at] = static_cast<char>(random.below(256));
        break;
    case 3:
        text.insert(at, text.substr(place(), length()));
        break;
    case 4:
        text.replace(at, length(), fragments[random.below(fragments.size())]);
        break;
    default:
        text.resize(at);
        break;
    }
}

std::string textOfNumber(std::uint64_t seed, std::uint64_t number) {
    Random random(seed, number);
    std::string text = seedText(random);
    for (std::uint64_t count = random.below(12); count > 0; --count) mutate(text, random);
    return text;
}

std::string textOfLine(const std::string& line) {
    std::string text;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool isCode = line[i] == '%' && i + 2 < line.size();
        text += isCode ? static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16)) : line[i];
        if (isCode) i += 2;
    }
    return text;
}

int tryCorpus(const char* path) {
    std::ifstream file(path);
    std::size_t count = 0;
    for (std::string line; std::getline(file, line); ++count) {
        const std::string broken = carom::test::brokenProperty(textOfLine(line));
        if (broken.empty()) continue;
        std::printf("line %zu of %s: %s\n%s\n", count + 1, path, broken.c_str(), line.c_str());
        return 1;
    }
    std::printf("%zu texts of %s: every property holds\n", count, path);
    return count > 0 ? 0 : 1;
}

} // namespace

int main(int argumentCount, char** arguments) {
    if (argumentCount == 3 && std::string_view(arguments[1]) == "--corpus") return tryCorpus(arguments[2]);
    const auto argument = [&](int i, std::uint64_t otherwise) {
        return i < argumentCount ? std::strtoull(arguments[i], nullptr, 10) : otherwise;
    };
    const std::uint64_t count = argument(1, 100'000);
    const std::uint64_t seed = argument(2, 1);
    const std::uint64_t first = argument(3, 0);
    for (std::uint64_t number = first; number < first + count; ++number) {
        const std::string text = textOfNumber(seed, number);
        const std::string broken = carom::test::brokenProperty(text);
        if (broken.empty()) continue;
        std::printf("seed %llu, text %llu: %s\n%s\n", static_cast<unsigned long long>(seed),
                    static_cast<unsigned long long>(number), broken.c_str(), text.c_str());
        return 1;
    }
    std::printf("%llu texts, seed %llu: every property holds\n", static_cast<unsigned long long>(count),
                static_cast<unsigned long long>(seed));
    return 0;
}
