// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/window/preferences.h"

#include "ui/viewport/drawing_place.h"
#include "ui/viewport/navigation.h"
#include "ui/base/actions.h"
#include "ui/base/settings.h"
#include "ui/window/translation.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFontComboBox>
#include <QFontInfo>
#include <QFormLayout>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTableWidget>
#include <QThread>
#include <QVBoxLayout>

#include <span>

namespace carom {
namespace {

constexpr QSize firstSize{640, 520}; // [px]
constexpr int leastFont = 6;         // [pt]
constexpr int mostFont = 40;         // [pt]
constexpr int leastMemory = 16;      // [MiB]
constexpr int mostMemory = 65536;    // [MiB]

bool belongsToAPanel(const QKeySequence& keys) {
    for (int digit = 0; digit < 10; ++digit)
        if (keys == QKeySequence(QStringLiteral("Alt+%1").arg(digit))) return true;
    return false;
}

QLabel* remark(const QString& text) {
    QLabel* label = new QLabel(text);
    label->setWordWrap(true);
    label->setProperty("role", QStringLiteral("muted"));
    return label;
}

QFormLayout* formOn(QWidget* page) {
    QFormLayout* form = new QFormLayout(page);
    form->setContentsMargins(16, 16, 16, 16);
    form->setVerticalSpacing(10);
    form->setHorizontalSpacing(16);
    return form;
}

/// To choose one of a catalogue's rows by its title; an item's data is the row's name.
template<class Row>
QComboBox* choiceOf(std::span<const Row> rows, const char* objectName, const QString& chosen) {
    QComboBox* choice = new QComboBox;
    choice->setObjectName(QLatin1String(objectName));
    for (const Row& row : rows) choice->addItem(Preferences::tr(row.title), QString::fromLatin1(row.name));
    choice->setCurrentIndex(std::max(0, choice->findData(chosen)));
    return choice;
}

} // namespace

Preferences::Preferences(Settings& settings, Actions& actions, QWidget* parent)
    : QDialog(parent), m_settings(settings), m_actions(actions) {
    setObjectName(QStringLiteral("preferences"));
    setWindowTitle(tr("Preferences"));
    QTabWidget* pages = new QTabWidget;
    pages->addTab(lookPage(), tr("Appearance"));
    pages->addTab(keysPage(), tr("Shortcuts"));
    pages->addTab(viewportPage(), tr("Viewport"));
    pages->addTab(simulationPage(), tr("Simulation"));
    QDialogButtonBox* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    QVBoxLayout* column = new QVBoxLayout(this);
    column->addWidget(pages, 1);
    column->addWidget(buttons);
    resize(firstSize);
}

QWidget* Preferences::lookPage() {
    QWidget* page = new QWidget;
    QFormLayout* form = formOn(page);
    QComboBox* theme = new QComboBox;
    theme->setObjectName(QStringLiteral("theme"));
    theme->addItems({tr("Dark"), tr("Light")});
    theme->setCurrentIndex(m_settings.darkTheme() ? 0 : 1);
    connect(theme, &QComboBox::currentIndexChanged, this,
            [this](int index) { Q_EMIT darkThemeChosen(index == 0); });
    form->addRow(tr("Theme"), theme);

    QFontComboBox* family = new QFontComboBox;
    family->setObjectName(QStringLiteral("fontFamily"));
    family->setFontFilters(QFontComboBox::MonospacedFonts);
    if (!m_settings.fontFamily().isEmpty()) family->setCurrentFont(QFont(m_settings.fontFamily()));
    QSpinBox* size = new QSpinBox;
    size->setObjectName(QStringLiteral("fontSize"));
    size->setRange(leastFont, mostFont);
    size->setSuffix(tr(" pt"));
    size->setValue(m_settings.fontSize());
    const auto chosen = [this, family, size] {
        m_settings.setFont(family->currentFont().family(), size->value());
        Q_EMIT fontChosen();
    };
    connect(family, &QFontComboBox::currentFontChanged, this, chosen);
    connect(size, &QSpinBox::valueChanged, this, chosen);
    form->addRow(tr("Font of the text"), family);
    form->addRow(tr("Size"), size);

    QComboBox* language = new QComboBox;
    language->setObjectName(QStringLiteral("language"));
    language->addItem(tr("As the system"), QString());
    for (const LanguageRow& row : languages())
        language->addItem(QString::fromUtf8(row.ownName), QString::fromLatin1(row.code));
    language->setCurrentIndex(std::max(0, language->findData(m_settings.language())));
    connect(language, &QComboBox::currentIndexChanged, this,
            [this, language] { m_settings.setLanguage(language->currentData().toString()); });
    form->addRow(tr("Language"), language);
    form->addRow(QString(), remark(tr("The language changes at the next start. The scene language and its "
                                      "messages stay English.")));
    return page;
}

QWidget* Preferences::keysPage() {
    QWidget* page = new QWidget;
    QVBoxLayout* column = new QVBoxLayout(page);
    column->setContentsMargins(16, 16, 16, 16);
    QLineEdit* words = new QLineEdit;
    words->setPlaceholderText(tr("Find a command"));
    words->setAccessibleName(tr("Find a command"));
    m_keys = new QTableWidget(0, 3);
    m_keys->setObjectName(QStringLiteral("keys"));
    m_keys->setHorizontalHeaderLabels({tr("Command"), tr("Shortcut"), QString()});
    m_keys->verticalHeader()->hide();
    m_keys->setSelectionMode(QAbstractItemView::NoSelection);
    m_keys->setFocusPolicy(Qt::NoFocus);
    m_keys->setShowGrid(false);
    m_keys->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
    m_keys->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Fixed);
    m_keys->horizontalHeader()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
    m_keys->setColumnWidth(1, 190);
    column->addWidget(words);
    column->addWidget(m_keys, 1);
    column->addWidget(remark(tr("A key that belongs to another command is taken from it; those of the "
                                "panels, Alt and a digit, stay theirs.")));
    connect(words, &QLineEdit::textChanged, this, &Preferences::fillKeys);
    fillKeys({});
    return page;
}

void Preferences::fillKeys(const QString& words) {
    m_keys->setRowCount(0);
    for (const ActionRow& row : actionRows()) {
        if (row.text == nullptr) continue;
        const QAction& action = m_actions[row.id];
        const QString title = action.text().remove(u'&').remove(u'…');
        if (!title.contains(words, Qt::CaseInsensitive)) continue;
        const int at = m_keys->rowCount();
        m_keys->insertRow(at);
        QTableWidgetItem* item = new QTableWidgetItem(title);
        item->setFlags(Qt::ItemIsEnabled);
        item->setToolTip(action.statusTip());
        m_keys->setItem(at, 0, item);
        const QString name = QString::fromLatin1(row.name);
        QKeySequenceEdit* edit = new QKeySequenceEdit(action.shortcut());
        edit->setObjectName(name);
        edit->setClearButtonEnabled(true);
        edit->setAccessibleName(tr("Shortcut of “%1”").arg(title));
        connect(edit, &QKeySequenceEdit::editingFinished, this,
                [this, name, edit] { setKeys(name, edit->keySequence()); });
        m_keys->setCellWidget(at, 1, edit);
        QPushButton* usual = new QPushButton(tr("Default"));
        usual->setToolTip(tr("Give the command its default shortcut"));
        connect(usual, &QPushButton::clicked, this, [this, id = row.id, name, edit] {
            m_settings.setKeysOf(name, std::nullopt);
            m_actions.takeKeys(m_settings);
            edit->setKeySequence(m_actions[id].shortcut());
            Q_EMIT keysChanged();
        });
        m_keys->setCellWidget(at, 2, usual);
        m_keys->setRowHeight(at, edit->sizeHint().height() + 6);
    }
}

/// What the command has now.
QKeySequence Preferences::keysOf(const QString& action) const {
    for (const ActionRow& row : actionRows())
        if (row.text != nullptr && action == QLatin1StringView(row.name)) return m_actions[row.id].shortcut();
    return {};
}

/// The name of the action that has these keys, other than `butNot`.
QString Preferences::holderOf(const QKeySequence& keys, const QString& butNot) const {
    for (const ActionRow& row : actionRows()) {
        if (row.text == nullptr || butNot == QLatin1String(row.name)) continue;
        if (m_actions[row.id].shortcuts().contains(keys)) return QString::fromLatin1(row.name);
    }
    return {};
}

void Preferences::setKeys(const QString& action, const QKeySequence& keys) {
    if (belongsToAPanel(keys)) { // two actions of one key would answer to neither
        QKeySequenceEdit* edit = m_keys->findChild<QKeySequenceEdit*>(action);
        if (edit != nullptr) edit->setKeySequence(keysOf(action));
        return;
    }
    const QString holder = keys.isEmpty() ? QString() : holderOf(keys, action);
    if (!holder.isEmpty()) {
        m_settings.setKeysOf(holder, QString());
        if (QKeySequenceEdit* other = m_keys->findChild<QKeySequenceEdit*>(holder)) other->clear();
    }
    m_settings.setKeysOf(action, keys.toString(QKeySequence::PortableText));
    m_actions.takeKeys(m_settings);
    Q_EMIT keysChanged();
}

QWidget* Preferences::viewportPage() {
    QWidget* page = new QWidget;
    QFormLayout* form = formOn(page);
    QComboBox* presets = choiceOf(navigationPresets(), "navigation", m_settings.navigation());
    connect(presets, &QComboBox::currentIndexChanged, this, [this, presets] {
        m_settings.setNavigation(presets->currentData().toString());
        Q_EMIT navigationChosen();
    });
    form->addRow(tr("Navigation"), presets);
    form->addRow(QString(),
                 remark(tr("The wheel zooms at the pointer and a click selects, whatever is chosen "
                           "here.")));
    QComboBox* places = choiceOf(drawingPlaces(), "drawingPlace", m_settings.drawingPlace());
    connect(places, &QComboBox::currentIndexChanged, this,
            [this, places] { m_settings.setDrawingPlace(places->currentData().toString()); });
    form->addRow(tr("Pictures are drawn"), places);
    form->addRow(QString(), remark(tr("This changes at the next start. What is drawn is the same.")));
    return page;
}

QWidget* Preferences::simulationPage() {
    QWidget* page = new QWidget;
    QFormLayout* form = formOn(page);
    QSpinBox* memory = new QSpinBox;
    memory->setObjectName(QStringLiteral("memory"));
    memory->setRange(leastMemory, mostMemory);
    memory->setSingleStep(leastMemory);
    memory->setSuffix(tr(" MiB"));
    memory->setGroupSeparatorShown(true);
    memory->setValue(m_settings.memoryBudget());
    connect(memory, &QSpinBox::valueChanged, this, [this](int mebibytes) {
        m_settings.setMemoryBudget(mebibytes);
        Q_EMIT memoryChosen();
    });
    form->addRow(tr("Rewind memory"), memory);
    QSpinBox* threads = new QSpinBox;
    threads->setObjectName(QStringLiteral("threads"));
    threads->setRange(0, 4 * std::max(1, QThread::idealThreadCount()));
    threads->setSpecialValueText(tr("as many as the machine has"));
    threads->setValue(m_settings.threads());
    connect(threads, &QSpinBox::valueChanged, this, [this](int count) {
        m_settings.setThreads(count);
        Q_EMIT threadsChosen();
    });
    form->addRow(tr("Threads"), threads);
    form->addRow(QString(), remark(tr("The motion does not depend on the number of threads.")));
    return page;
}

} // namespace carom

#include "moc_preferences.cpp"
