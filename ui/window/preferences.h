// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QKeySequence>

class QTableWidget;

namespace carom {

class Actions;
class Settings;

/// What one may set once and forget. Every change holds at once and is kept; nothing needs to be confirmed.
class Preferences : public QDialog {
    Q_OBJECT
  public:
    Preferences(Settings& settings, Actions& actions, QWidget* parent);

  Q_SIGNALS:
    void darkThemeChosen(bool dark);
    void fontChosen();
    void navigationChosen();
    void threadsChosen();
    void memoryChosen();
    void keysChanged();

  private:
    QWidget* lookPage();
    QWidget* keysPage();
    QWidget* viewportPage();
    QWidget* simulationPage();
    void fillKeys(const QString& words);
    void setKeys(const QString& action, const QKeySequence& keys);
    QString holderOf(const QKeySequence& keys, const QString& butNot) const;
    QKeySequence keysOf(const QString& action) const;

    Settings& m_settings;
    Actions& m_actions;
    QTableWidget* m_keys = nullptr;
};

} // namespace carom
