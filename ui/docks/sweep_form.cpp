// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/docks/sweep_form.h"

#include "core/language/sweep_proposals.h"
#include "ui/widgets/panel_parts.h"
#include "ui/widgets/text_of.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QMenu>
#include <QPlainTextEdit>
#include <QSpinBox>
#include <QToolButton>

#include <algorithm>
#include <limits>

namespace carom {
namespace {

constexpr int mostCount = std::numeric_limits<int>::max();

/// A count of a declaration as a field holds it.
int countOf(std::int64_t count) { return static_cast<int>(std::min<std::int64_t>(count, mostCount)); }

/// A field for texts, one a line, so many lines high.
QPlainTextEdit* lineField(const char* name, const QString& label, int lines) {
    QPlainTextEdit* field = new QPlainTextEdit;
    field->setObjectName(QLatin1StringView(name));
    field->setAccessibleName(label);
    field->setTabChangesFocus(true);
    field->setLineWrapMode(QPlainTextEdit::NoWrap);
    field->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    constexpr int frame = 12; // [px] above and below the lines
    field->setFixedHeight(lines * field->fontMetrics().lineSpacing() + frame);
    return field;
}

QSpinBox* countField(const char* name, const QString& label, const QString& none, const QString& tip) {
    QSpinBox* field = new QSpinBox;
    field->setObjectName(QLatin1StringView(name));
    field->setAccessibleName(label);
    field->setToolTip(tip);
    field->setRange(0, mostCount);
    field->setSpecialValueText(none);
    return field;
}

std::vector<std::string> linesOf(const QPlainTextEdit& field) {
    std::vector<std::string> lines;
    for (const QString& line : field.toPlainText().split(u'\n'))
        if (const QString text = line.trimmed(); !text.isEmpty()) lines.push_back(text.toStdString());
    return lines;
}

QString inLines(const std::vector<std::string>& texts) {
    QStringList lines;
    for (const std::string& text : texts) lines += textOf(text);
    return lines.join(u'\n');
}

} // namespace

SweepForm::SweepForm(QWidget* parent)
    : QWidget(parent), m_vary(lineField("sweepVary", tr("What is varied"), 3)),
      m_measures(lineField("sweepMeasures", tr("What is measured"), 2)),
      m_choose(wordButton("sweepChoose", tr("Choose"), tr("Measures that suit what is varied"))),
      m_zip(new QCheckBox(tr("together"))),
      m_frames(countField("sweepFrames", tr("Frames of each run"), tr("as the scene says"),
                          tr("Frames of each run"))),
      m_seeds(countField("sweepSeeds", tr("Seeds"), tr("none"),
                         tr("Runs of each point, each with the next seed of the generated scene"))),
      m_random(countField("sweepRandom", tr("Draws"), tr("none"),
                          tr("Draws from laws such as `uniform 4:12` and `normal 8:0.5`"))) {
    m_vary->setPlaceholderText(QStringLiteral("cue.vel.x=4:12:17"));
    m_vary->setToolTip(tr("Which numbers are varied, one a line: `first:last:count`, `log 1e-3:1:7`, a list "
                          "`1,4,16` of numbers or words, or a law"));
    m_measures->setPlaceholderText(QStringLiteral("max penetration"));
    m_measures->setToolTip(tr("Which figures are taken from each run, one a line: `final y of ball`, `speed "
                              "of ball at 1.5`, `first impact of a and b`"));
    m_choose->setPopupMode(QToolButton::InstantPopup);
    m_choose->setMenu(new QMenu(m_choose));
    m_zip->setObjectName(QStringLiteral("sweepZip"));
    m_zip->setToolTip(tr("Values go together, first with first, instead of each with each"));
    const auto word = [](const QString& text, QWidget* buddy) {
        QLabel* label = new QLabel(text);
        label->setBuddy(buddy);
        return label;
    };
    QGridLayout* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setVerticalSpacing(3);
    grid->addWidget(word(tr("Vary"), m_vary), 0, 0);
    grid->addWidget(m_zip, 0, 2, Qt::AlignRight);
    grid->addWidget(m_vary, 1, 0, 1, 3);
    grid->addWidget(word(tr("Measure"), m_measures), 2, 0);
    grid->addWidget(m_choose, 2, 2, Qt::AlignRight);
    grid->addWidget(m_measures, 3, 0, 1, 3);
    grid->addWidget(word(tr("Frames"), m_frames), 4, 0);
    grid->addWidget(word(tr("Seeds"), m_seeds), 4, 1);
    grid->addWidget(word(tr("Draws"), m_random), 4, 2);
    grid->addWidget(m_frames, 5, 0);
    grid->addWidget(m_seeds, 5, 1);
    grid->addWidget(m_random, 5, 2);
    setFocusProxy(m_vary);

    for (QPlainTextEdit* field : {m_vary, m_measures})
        connect(field, &QPlainTextEdit::textChanged, this, &SweepForm::changed);
    for (QSpinBox* field : {m_frames, m_seeds, m_random})
        connect(field, &QSpinBox::valueChanged, this, &SweepForm::changed);
    connect(m_zip, &QCheckBox::toggled, this, &SweepForm::changed);
    connect(m_choose->menu(), &QMenu::aboutToShow, this, &SweepForm::fillMeasures);
}

void SweepForm::setScene(const SharedBuild& build) {
    m_build = build;
    const std::optional<SweepRequest>& request = build->scene().sweep;
    std::optional<SweepDefinition> declared;
    if (request) declared = definitionOf(*request);
    const bool isNew = declared && declared != m_declared;
    m_declared = declared;
    if (isNew)
        fill(*declared);
    else if (build->fresh && !declared)
        fill({});
}

void SweepForm::fill(const SweepDefinition& definition) {
    m_vary->setPlainText(inLines(definition.vary));
    m_measures->setPlainText(inLines(definition.measures));
    m_zip->setChecked(definition.zip);
    m_frames->setValue(countOf(definition.frames.value_or(0)));
    m_seeds->setValue(countOf(definition.seeds));
    m_random->setValue(countOf(definition.random));
    m_proposedMeasure.clear();
    m_proposedPath.clear();
}

void SweepForm::propose(const QString& path, bool together) {
    if (!m_build) return;
    const Analysis& analysis = m_build->build.analysis;
    m_proposedPath = path;
    const QString vary = QString::fromStdString(proposedVary(analysis, path.toStdString()));
    m_vary->setPlainText(together ? m_vary->toPlainText().trimmed() + u'\n' + vary : vary);
    const QString measures = m_measures->toPlainText().trimmed();
    if (measures.isEmpty() || measures == m_proposedMeasure) {
        m_proposedMeasure = textOf(proposedMeasures(analysis, path.toStdString()).front());
        m_measures->setPlainText(m_proposedMeasure);
    }
}

QString SweepForm::onlyPath() const {
    const std::vector<std::string> vary = linesOf(*m_vary);
    return vary.size() == 1 ? textOf(vary.front()).section(u'=', 0, 0) : QString();
}

/// Every time: the text may have changed.
void SweepForm::fillMeasures() {
    QMenu& menu = *m_choose->menu();
    menu.clear();
    if (!m_build) return;
    const QString path = m_proposedPath.isEmpty() ? onlyPath() : m_proposedPath;
    for (const std::string& measure : proposedMeasures(m_build->build.analysis, path.toStdString())) {
        const QString text = textOf(measure);
        connect(menu.addAction(text), &QAction::triggered, this, [this, text] { takeMeasure(text); });
    }
}

/// In the place of one that was proposed; behind those that were written.
void SweepForm::takeMeasure(const QString& measure) {
    const QString measures = m_measures->toPlainText().trimmed();
    const bool replaces = measures.isEmpty() || measures == m_proposedMeasure;
    m_measures->setPlainText(replaces ? measure : measures + u'\n' + measure);
    m_proposedMeasure.clear();
}

SweepDefinition SweepForm::definition() const {
    SweepDefinition definition;
    definition.vary = linesOf(*m_vary);
    definition.measures = linesOf(*m_measures);
    definition.zip = m_zip->isChecked();
    definition.random = m_random->value();
    definition.seeds = m_seeds->value();
    if (m_frames->value() > 0) definition.frames = m_frames->value();
    return definition;
}

bool SweepForm::leavesDeclarationAside() const {
    if (!m_declared) return false;
    const SweepDefinition asked = definition();
    return (m_declared->zip && !asked.zip) || (m_declared->random > 0 && asked.random == 0) ||
           (m_declared->seeds > 0 && asked.seeds == 0) || (m_declared->frames && !asked.frames);
}

bool SweepForm::isFilled() const { return !linesOf(*m_vary).empty() && !linesOf(*m_measures).empty(); }

} // namespace carom

#include "moc_sweep_form.cpp"
