// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/generators/generator.h"
#include "core/simulation/build.h"

#include <QByteArray>
#include <QDialog>
#include <QThreadPool>
#include <QTimer>

#include <functional>
#include <map>
#include <memory>
#include <string>

class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace carom {

class Viewport;

/// A new scene from a template, or from a generator with its options; what would be made is shown as it is
/// chosen. Texts are made on a thread of their own: only the newest choice is waited for.
class NewSceneDialog : public QDialog {
    Q_OBJECT
  public:
    NewSceneDialog(bool dark, QWidget* parent);
    ~NewSceneDialog() override;

    /// The chosen scene's text.
    const QByteArray& text() const { return m_text; }
    /// What it is made by, for the message: "pool_break".
    QString name() const;

  Q_SIGNALS:
    /// The preview shows the newest choice.
    void previewed(std::size_t bodies);

  private:
    struct Made {
        QByteArray text;
        std::shared_ptr<const Build> build; ///< null where the scene is too large to show
    };

    void fillList();
    void showOptions();
    void showGenerator(const GeneratorRow& row);
    QDoubleSpinBox* optionField(const GeneratorOption& option);
    std::function<QByteArray()> recipe() const;
    void make();
    void take(int turn, const Made& made);

    QListWidget* m_list;
    QLabel* m_help;
    QFormLayout* m_form;
    Viewport* m_preview;
    QLabel* m_facts;
    QPushButton* m_create = nullptr;
    QSpinBox* m_count = nullptr; ///< of the generator shown; null where it takes none
    QSpinBox* m_seed = nullptr;
    std::map<std::string, QDoubleSpinBox*, std::less<>> m_options;
    QTimer m_idle;
    int m_turn = 0; ///< of choices made; a result of an earlier one is dropped
    QThreadPool m_worker;
    QByteArray m_text;
};

} // namespace carom
