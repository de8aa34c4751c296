// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/new_scene_dialog.h"

#include "ui/base/failures.h"
#include "ui/base/pauses.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/resources.h"
#include "ui/widgets/text_of.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {
namespace {

constexpr QSize firstSize{980, 560}; // [px]
constexpr int listWidth = 200;       // [px]
constexpr int formWidth = 300;       // [px]
constexpr int idleTime = 120;        // [ms] after the last change of an option until the preview is made
constexpr qsizetype largestPreview = 4 << 20; // [bytes] of text; some 30,000 bodies, at twice 60,000: slow
constexpr int largestCount = 10'000'000;      // what a spin box offers at most
constexpr int nameRole = Qt::UserRole;        // a generator's name, or a template's file
constexpr int isTemplateRole = Qt::UserRole + 1;

/// "pool_break" as one would read it: "Pool break".
QString title(QString name) {
    name.replace(u'_', u' ');
    if (!name.isEmpty()) name[0] = name[0].toUpper();
    return name;
}

/// The comment a template begins with.
QString headOf(const QByteArray& text) {
    QStringList lines;
    for (const QByteArray& line : text.split('\n')) {
        if (!line.startsWith("//")) break;
        lines.append(QString::fromUtf8(line.mid(2)).trimmed());
    }
    return lines.join(u' ');
}

void clear(QFormLayout& form) {
    while (form.rowCount() > 0) form.removeRow(0);
}

} // namespace

NewSceneDialog::NewSceneDialog(bool dark, QWidget* parent)
    : QDialog(parent), m_list(new QListWidget), m_help(new QLabel), m_form(new QFormLayout),
      m_preview(new Viewport), m_facts(new QLabel) {
    setObjectName(QStringLiteral("newScene"));
    setWindowTitle(tr("New scene from a template or generator"));
    m_list->setFixedWidth(listWidth);
    m_list->setAccessibleName(tr("Templates and generators"));
    m_help->setWordWrap(true);
    m_preview->setDarkTheme(dark);
    m_preview->setMinimumSize(360, 300);
    m_facts->setProperty("role", QStringLiteral("muted"));

    QWidget* options = new QWidget;
    options->setFixedWidth(formWidth);
    QVBoxLayout* column = new QVBoxLayout(options);
    column->setContentsMargins(8, 0, 8, 0);
    column->setSpacing(12);
    column->addWidget(m_help);
    m_form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    column->addLayout(m_form);
    column->addStretch(1);

    QDialogButtonBox* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    m_create = buttons->addButton(tr("&Create"), QDialogButtonBox::AcceptRole);
    m_create->setObjectName(QStringLiteral("create"));
    m_create->setDefault(true);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    QVBoxLayout* picture = new QVBoxLayout;
    picture->addWidget(m_preview, 1);
    picture->addWidget(m_facts);
    QHBoxLayout* row = new QHBoxLayout;
    row->addWidget(m_list);
    row->addWidget(options);
    row->addLayout(picture, 1);
    QVBoxLayout* whole = new QVBoxLayout(this);
    whole->addLayout(row, 1);
    whole->addWidget(buttons);

    m_worker.setMaxThreadCount(1);
    m_idle.setSingleShot(true);
    m_idle.setInterval(pauseOf(idleTime));
    connect(&m_idle, &QTimer::timeout, this, &NewSceneDialog::make);
    connect(m_list, &QListWidget::currentItemChanged, this, &NewSceneDialog::showOptions);
    fillList();
    resize(firstSize);
}

NewSceneDialog::~NewSceneDialog() { m_worker.waitForDone(); }

QString NewSceneDialog::name() const { return m_list->currentItem()->data(nameRole).toString(); }

void NewSceneDialog::fillList() {
    const auto heading = [this](const QString& text) {
        QListWidgetItem* item = new QListWidgetItem(text, m_list);
        item->setFlags(Qt::NoItemFlags);
    };
    const auto entry = [this](const QString& text, const QString& name, bool isTemplate) {
        QListWidgetItem* item = new QListWidgetItem(QStringLiteral("  ") + text, m_list);
        item->setData(nameRole, name);
        item->setData(isTemplateRole, isTemplate);
    };
    heading(tr("Templates"));
    for (const QString& file : QDir(QStringLiteral(":/templates")).entryList())
        entry(title(file.chopped(4)), file, true); // without ".sdl"
    heading(tr("Generators"));
    for (const GeneratorRow& row : generators()) entry(title(textOf(row.name)), textOf(row.name), false);
    m_list->setCurrentRow(1);
}

void NewSceneDialog::showOptions() {
    clear(*m_form);
    m_options.clear();
    m_count = m_seed = nullptr;
    const QListWidgetItem* item = m_list->currentItem();
    if (item == nullptr) return;
    if (item->data(isTemplateRole).toBool())
        m_help->setText(headOf(resource(QStringLiteral("templates/") + name())));
    else if (const GeneratorRow* row = findGenerator(name().toStdString()))
        showGenerator(*row);
    make();
}

void NewSceneDialog::showGenerator(const GeneratorRow& row) {
    m_help->setText(textOf(row.help));
    const auto changed = [this] { m_idle.start(); };
    if (row.defaultN > 0) {
        m_count = new QSpinBox;
        m_count->setObjectName(QStringLiteral("count"));
        m_count->setRange(static_cast<int>(row.minimumN),
                          static_cast<int>(std::min<std::int64_t>(row.maximumN, largestCount)));
        m_count->setValue(static_cast<int>(row.defaultN));
        m_count->setGroupSeparatorShown(true);
        connect(m_count, &QSpinBox::valueChanged, this, changed);
        m_form->addRow(tr("How many"), m_count);
    }
    for (const GeneratorOption& option : row.options) {
        QDoubleSpinBox* field = optionField(option);
        connect(field, &QDoubleSpinBox::valueChanged, this, changed);
        m_form->addRow(title(textOf(option.name)), field);
        m_options[std::string(option.name)] = field;
    }
    m_seed = new QSpinBox;
    m_seed->setObjectName(QStringLiteral("seed"));
    m_seed->setRange(0, std::numeric_limits<int>::max());
    m_seed->setValue(1);
    m_seed->setToolTip(tr("The same seed gives the same scene on every machine"));
    connect(m_seed, &QSpinBox::valueChanged, this, changed);
    m_form->addRow(tr("Seed"), m_seed);
}

QDoubleSpinBox* NewSceneDialog::optionField(const GeneratorOption& option) {
    constexpr int digits = 3; // significant ones of the default that a step keeps
    const double scale = option.defaultValue != 0 ? std::abs(option.defaultValue) : 1;
    const int decimals = std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(scale))), 0, 6);
    QDoubleSpinBox* field = new QDoubleSpinBox;
    field->setObjectName(textOf(option.name));
    field->setDecimals(decimals);
    field->setRange(option.minimum, option.maximum);
    field->setSingleStep(std::max(std::pow(10.0, -decimals), scale / 10));
    field->setValue(option.defaultValue);
    if (!option.unit.empty()) field->setSuffix(QStringLiteral(" ") + textOf(option.unit));
    field->setToolTip(textOf(option.help));
    field->setAccessibleName(textOf(option.help));
    return field;
}

/// How the chosen text is made; to be run on any thread.
std::function<QByteArray()> NewSceneDialog::recipe() const {
    if (m_list->currentItem()->data(isTemplateRole).toBool())
        return [text = resource(QStringLiteral("templates/") + name())] { return text; };
    const GeneratorRow* row = findGenerator(name().toStdString());
    GeneratorRequest request;
    if (m_count != nullptr) request.n = m_count->value();
    request.seed = static_cast<std::uint64_t>(m_seed->value());
    for (const auto& [option, field] : m_options) request.options[option] = field->value();
    return [row, request] {
        if (const std::optional<std::string> refusal = checkRequest(*row, request))
            return QByteArray("// " + QByteArray::fromStdString(*refusal) + "\n");
        return QByteArray::fromStdString(generate(*row, request));
    };
}

void NewSceneDialog::make() {
    m_idle.stop();
    m_create->setEnabled(false);
    const int turn = ++m_turn;
    m_worker.clear();
    m_worker.start([this, turn, make = recipe()] {
        Made made;
        const QString problem = attempt([&] {
            made.text = make();
            if (made.text.size() <= largestPreview)
                made.build = std::make_shared<const Build>(carom::build(made.text.toStdString()));
        });
        if (!problem.isEmpty()) made = {"// " + problem.toUtf8() + "\n", nullptr};
        QMetaObject::invokeMethod(
            this, [this, turn, made] { take(turn, made); }, Qt::QueuedConnection);
    });
}

void NewSceneDialog::take(int turn, const Made& made) {
    if (turn != m_turn) return;
    m_text = made.text;
    m_create->setEnabled(true);
    const QString size = QLocale().formattedDataSize(made.text.size());
    if (!made.build) {
        m_preview->showPipeline(nullptr);
        m_facts->setText(tr("%1 of text: too large to preview").arg(size));
        Q_EMIT previewed(0);
        return;
    }
    m_preview->showPipeline(nullptr); // the camera is set anew
    m_preview->showPipeline(made.build->pipeline);
    const std::size_t bodies = made.build->analysis.scene.bodies.size();
    m_facts->setText(tr("%1 bodies, %2 of text").arg(bodies).arg(size));
    Q_EMIT previewed(bodies);
}

} // namespace carom

#include "moc_new_scene_dialog.cpp"
