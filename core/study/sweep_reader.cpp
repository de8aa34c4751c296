// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/study/sweep_reader.h"

#include "core/base/catalogue.h"
#include "core/base/figures.h"
#include "core/base/text.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace carom {
namespace {

constexpr double largestWhole = 9007199254740992; ///< 2^53: up to it doubles count one by one

} // namespace

ReadRequest readRequest(std::string_view text) {
    const std::vector<std::string> words = wordsIn(text);
    ReadRequest read;
    const std::string name = words.empty() ? "" : words.front();
    const GeneratorRow* row = findGenerator(name);
    if (row == nullptr) {
        const std::optional<std::string_view> near = nearestRow(name, generators());
        read.objection = "there is no generator `" + name + "`" +
                         (near ? "; did you mean `" + std::string(*near) + "`?" : "");
        return read;
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        std::string option = words[i].substr(0, equals), value;
        if (equals != std::string::npos)
            value = words[i].substr(equals + 1);
        else if (i + 1 < words.size())
            value = words[++i];
        const std::size_t dashes = std::min(option.find_first_not_of('-'), option.size());
        const std::optional<double> number = looseNumberIn(value);
        if (dashes == 0 || dashes > 2 || !number) {
            read.objection = "`" + option + " " + value + "` is no option with a number";
            return read;
        }
        option.erase(0, dashes);
        const bool isWhole = *number == std::trunc(*number) && std::abs(*number) <= largestWhole;
        if ((option == "n" || option == "seed") && (!isWhole || (option == "seed" && *number < 0))) {
            read.objection = "`--" + option + "` is " + value + "; it must be a whole number";
            return read;
        }
        setOption(read.request, option, *number);
    }
    if (const std::optional<std::string> reason = checkRequest(*row, read.request))
        read.objection = *reason;
    else
        read.generator = row;
    return read;
}

void setOption(GeneratorRequest& request, const std::string& name, double value) {
    if (name == "n")
        request.n = static_cast<std::int64_t>(value);
    else if (name == "seed")
        request.seed = static_cast<std::uint64_t>(value);
    else
        request.options[name] = value;
}

/// Reads a definition step by step; the first objection ends it.
class SweepReader {
  public:
    SweepReader(SweepDefinition definition, std::string text) : m_text(std::move(text)) {
        m_sweep->m_definition = std::move(definition);
    }

    ReadSweep read() {
        for (void (SweepReader::*step)() :
             {&SweepReader::readBase, &SweepReader::readVaries, &SweepReader::addSeeds,
              &SweepReader::makeAxes, &SweepReader::checkValues, &SweepReader::readMeasures,
              &SweepReader::checkFirstRun}) {
            (this->*step)();
            if (!m_objection.empty()) return {nullptr, m_objection};
        }
        return {std::move(m_sweep), {}};
    }

  private:
    const SweepDefinition& definition() const { return m_sweep->m_definition; }
    const Analysis& analysis() const { return m_sweep->m_base->analysis; }
    bool isOption(const SweptParameter& parameter) const {
        return m_sweep->m_generator != nullptr && parameter.path.owner == "generate";
    }

    void readBase() {
        if (!definition().generate.empty()) {
            ReadRequest read = readRequest(definition().generate);
            m_objection = read.objection;
            if (!m_objection.empty()) return;
            m_sweep->m_generator = read.generator;
            m_sweep->m_request = read.request;
            m_text = generate(*read.generator, read.request);
        }
        m_sweep->m_base = std::make_shared<const Build>(build(std::move(m_text)));
        for (const Diagnostic& diagnostic : m_sweep->m_base->diagnostics)
            if (diagnostic.severity() == Severity::Error && m_objection.empty())
                m_objection = "the scene has errors: " + diagnostic.message;
    }

    void readVaries() {
        std::set<std::string> names;
        for (const std::string& vary : definition().vary) {
            SweptParameter parameter;
            std::string objection = readVary(vary, parameter);
            if (objection.empty() && !names.insert(parameter.name).second) objection = "it is varied twice";
            if (objection.empty()) objection = lookUp(parameter);
            if (!objection.empty()) {
                m_objection = "`" + vary + "`: " + objection;
                return;
            }
            m_sweep->m_parameters.push_back(std::move(parameter));
        }
    }

    std::string lookUp(SweptParameter& parameter) const {
        const bool isRandom = parameter.law != SweptParameter::Law::Listed;
        if (isRandom && definition().random == 0) return "a law needs a number of draws (`--random N`)";
        if (isOption(parameter)) {
            const std::string& option = parameter.path.parameter;
            if (parameter.path.component >= 0) return "options of a generator have no components";
            parameter.isWhole = option == "n" || option == "seed";
            if (!parameter.isWhole && !findByName(m_sweep->m_generator->options, option)) {
                const std::optional<std::string_view> near =
                    nearestRow(option, m_sweep->m_generator->options);
                return "`" + std::string(m_sweep->m_generator->name) + "` has no option `" + option + "`" +
                       (near ? "; did you mean `" + std::string(*near) + "`?" : "");
            }
            return {};
        }
        const ParameterPlace place = findParameter(analysis(), parameter.path);
        if (place.parameter == nullptr) return place.objection;
        parameter.isWhole = place.parameter->kind == ValueKind::WholeNumber;
        return {};
    }

    void addSeeds() {
        if (definition().seeds == 0) return;
        SweptParameter seeds;
        seeds.name = "seed";
        seeds.path = {"generate", "seed", -1};
        seeds.law = SweptParameter::Law::Consecutive;
        seeds.isWhole = true;
        const std::optional<Generated>& declared = analysis().scene.generated;
        if (m_sweep->m_generator == nullptr && !declared)
            m_objection = "`seeds` needs a generated scene (`--generate`, or a `generate` declaration); "
                          "without one all its runs are the same";
        for (const SweptParameter& other : m_sweep->m_parameters)
            if (other.path.owner == "generate" && other.path.parameter == "seed")
                m_objection = "`generate.seed` is varied, and `seeds` would vary it again";
        if (!m_objection.empty()) return;
        seeds.a = m_sweep->m_generator ? static_cast<double>(m_sweep->m_request.seed) : declared->seed;
        m_sweep->m_parameters.push_back(std::move(seeds));
    }

    void makeAxes() {
        SweepAxis zipped, drawn{.parameters = {},
                                .count = static_cast<std::size_t>(definition().random),
                                .isReplication = true};
        SweepAxis seeds{
            .parameters = {}, .count = static_cast<std::size_t>(definition().seeds), .isReplication = true};
        std::vector<SweepAxis>& axes = m_sweep->m_axes;
        for (std::size_t k = 0; k < m_sweep->m_parameters.size(); ++k) {
            const SweptParameter& parameter = m_sweep->m_parameters[k];
            if (parameter.law == SweptParameter::Law::Consecutive) {
                seeds.parameters.push_back(k);
            } else if (parameter.law != SweptParameter::Law::Listed) {
                drawn.parameters.push_back(k);
            } else if (!definition().zip) {
                axes.push_back({{k}, parameter.values.size(), false});
            } else {
                if (!zipped.parameters.empty() && zipped.count != parameter.values.size())
                    m_objection = "`" + parameter.name + "` has " +
                                  counted(parameter.values.size(), "value", "values") + " and `" +
                                  m_sweep->m_parameters[zipped.parameters.front()].name + "` " +
                                  std::to_string(zipped.count) + "; to go together they need equally many";
                zipped.parameters.push_back(k);
                zipped.count = parameter.values.size();
            }
        }
        if (definition().random > 0 && drawn.parameters.empty())
            m_objection = "`random` needs a law to draw from, such as `cue.vel.x=uniform 4:12`";
        for (SweepAxis* axis : {&zipped, &drawn, &seeds})
            if (!axis->parameters.empty()) axes.push_back(std::move(*axis));
        for (const SweepAxis& axis : axes) {
            if (axis.count > Sweep::mostRuns / m_sweep->m_runs)
                m_objection = "the sweep has more than 100000000 runs";
            if (!m_objection.empty()) return;
            m_sweep->m_runs *= axis.count;
        }
    }

    void checkValues() {
        for (const SweptParameter& parameter : m_sweep->m_parameters) {
            const ParameterPlace place =
                isOption(parameter) ? ParameterPlace() : findParameter(analysis(), parameter.path);
            for (const std::string& value : parameter.values) {
                const std::optional<std::string> objection = isOption(parameter)
                                                                 ? objectionToOption(parameter, value)
                                                                 : objectionToValue(analysis(), place, value);
                if (!objection) continue;
                m_objection = "`" + parameter.name + "`: " + *objection;
                return;
            }
        }
    }

    std::optional<std::string> objectionToOption(const SweptParameter& parameter,
                                                 const std::string& value) const {
        const std::optional<double> number = numberIn(value);
        if (!number) return "`" + value + "` is no number";
        const double least = parameter.path.parameter == "seed" ? 0 : -largestWhole;
        if (parameter.isWhole &&
            (*number != std::trunc(*number) || *number < least || *number > largestWhole))
            return "`" + value + "` must be a whole number";
        GeneratorRequest request = m_sweep->m_request;
        setOption(request, parameter.path.parameter, *number);
        return checkRequest(*m_sweep->m_generator, request);
    }

    void readMeasures() {
        if (definition().measures.empty()) {
            m_objection = "there is nothing to measure; a measure is for instance `max penetration`";
            return;
        }
        for (const std::string& text : definition().measures) {
            ReadMeasure read = readMeasure(text);
            m_objection = read.objection;
            if (!m_objection.empty()) return;
            const bool known =
                std::ranges::count(m_sweep->m_measures, read.measure->text, &SweepMeasure::text);
            if (known) m_objection = "`" + text + "` is measured twice";
            if (known) return;
            m_sweep->m_measures.push_back(std::move(*read.measure));
        }
    }

    void checkFirstRun() {
        const Build built = build(m_sweep->textOf(0).value_or(std::string()));
        for (const Diagnostic& diagnostic : built.diagnostics)
            if (diagnostic.severity() == Severity::Error) {
                m_objection = "the first run has errors: " + diagnostic.message;
                return;
            }
        for (const SweepMeasure& measure : m_sweep->m_measures)
            if (const std::optional<std::string> objection = objectionToMeasure(measure, *built.pipeline)) {
                m_objection = *objection;
                return;
            }
    }

    std::string m_text;
    std::shared_ptr<Sweep> m_sweep{new Sweep};
    std::string m_objection;
};

ReadSweep readSweep(SweepDefinition definition, std::string text) {
    return SweepReader(std::move(definition), std::move(text)).read();
}

} // namespace carom
