<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>AccuracyChart</name>
    <message>
        <source>time per simulated second</source>
        <translation>Zeit für eine simulierte Sekunde</translation>
    </message>
    <message>
        <source>real time</source>
        <translation>Echtzeit</translation>
    </message>
    <message>
        <source> (order %1)</source>
        <translation> (Ordnung %1)</translation>
    </message>
    <message>
        <source>deviation from the finest run</source>
        <translation>Abweichung vom feinsten Lauf</translation>
    </message>
    <message>
        <source>an invariant broke</source>
        <translation>eine Erhaltungsgröße ist verletzt</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>gescheitert</translation>
    </message>
    <message>
        <source>the scene&apos;s own</source>
        <translation>die der Szene</translation>
    </message>
    <message>
        <source>Pareto front</source>
        <translation>Pareto-Front</translation>
    </message>
    <message>
        <source>%1
error %2 (distance %3, angle %4 rad)</source>
        <translation>%1
Fehler %2 (Abstand %3, Winkel %4 rad)</translation>
    </message>
    <message>
        <source>
%1 ms per simulated second (%2 to %3)</source>
        <translation>
%1 ms für eine simulierte Sekunde (%2 bis %3)</translation>
    </message>
    <message>
        <source>
energy off by %1, drift %2 /s; overlap %3</source>
        <translation>
Energie um %1 falsch, Drift %2 /s; Überlappung %3</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>recommended</source>
        <translation>empfohlen</translation>
    </message>
    <message>
        <source>
%1 of %2 impacts; up to number %3 off by %4 s at most</source>
        <translation>
%1 von %2 Stößen; bis Nummer %3 um höchstens %4 s daneben</translation>
    </message>
    <message>
        <source>
beyond the horizon, medians of %1 copies: speeds off by %2 %, pressure by %3 %, time between impacts by %4 %</source>
        <translation>
jenseits des Horizonts, Mediane von %1 Kopien: Geschwindigkeiten um %2 % daneben, Druck um %3 %, Zeit zwischen Stößen um %4 %</translation>
    </message>
    <message>
        <source>
%1 %2</source>
        <comment>a measure and its value</comment>
        <translation>
%1 %2</translation>
    </message>
    <message>
        <source>chosen</source>
        <translation>gewählt</translation>
    </message>
</context>
<context>
    <name>BenchmarkCharts</name>
    <message>
        <source>number of objects N</source>
        <translation>Zahl der Körper N</translation>
    </message>
    <message>
        <source>simulation time of a frame</source>
        <translation>Rechenzeit eines Bildes</translation>
    </message>
    <message>
        <source>Frame rate against number of objects: %1</source>
        <translation>Bildrate gegen die Zahl der Körper: %1</translation>
    </message>
    <message>
        <source>frame rate</source>
        <translation>Bildrate</translation>
    </message>
    <message>
        <source>30 frames/s</source>
        <translation>30 Bilder/s</translation>
    </message>
    <message>
        <source>%1: parabola</source>
        <translation>%1: Parabel</translation>
    </message>
    <message>
        <source>All pairs and sweep and sort: %1</source>
        <translation>Alle Paare und Sweep-and-Sort: %1</translation>
    </message>
    <message>
        <source>33 ms: 30 frames/s</source>
        <translation>33 ms: 30 Bilder/s</translation>
    </message>
    <message>
        <source>%1: %2, N = %3</source>
        <translation>%1: %2, N = %3</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Every algorithm</source>
        <translation>Alle Verfahren</translation>
    </message>
</context>
<context>
    <name>Charts</name>
    <message>
        <source>What accuracy costs: %1</source>
        <translation>Was Genauigkeit kostet: %1</translation>
    </message>
</context>
<context>
    <name>ColourPicker</name>
    <message>
        <source>Choose a colour</source>
        <translation>Eine Farbe wählen</translation>
    </message>
</context>
<context>
    <name>ComparisonCharts</name>
    <message>
        <source>Broad-phase in each frame</source>
        <translation>Grobphase in jedem Bild</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Whole step in each frame</source>
        <translation>Ganzer Schritt in jedem Bild</translation>
    </message>
    <message>
        <source>Pairs tested in each frame</source>
        <translation>Geprüfte Paare in jedem Bild</translation>
    </message>
    <message>
        <source>pairs tested</source>
        <translation>geprüfte Paare</translation>
    </message>
    <message>
        <source>Broad [ms]</source>
        <translation>Grob [ms]</translation>
    </message>
    <message>
        <source>Step [ms]</source>
        <translation>Schritt [ms]</translation>
    </message>
    <message>
        <source>First [ms]</source>
        <translation>Erstes [ms]</translation>
    </message>
    <message>
        <source>Tested</source>
        <translation>Geprüft</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Überlappt</translation>
    </message>
    <message>
        <source>Ratio</source>
        <translation>Verhältnis</translation>
    </message>
    <message>
        <source>N=%1</source>
        <translation>N=%1</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
</context>
<context>
    <name>Export</name>
    <message>
        <source>Export</source>
        <translation>Ausgeben</translation>
    </message>
    <message>
        <source>%1 files (*.%2)</source>
        <translation>%1-Dateien (*.%2)</translation>
    </message>
    <message>
        <source>Written to %1</source>
        <translation>Nach %1 geschrieben</translation>
    </message>
    <message>
        <source>Not exported: %1</source>
        <translation>Nicht ausgegeben: %1</translation>
    </message>
</context>
<context>
    <name>Failures</name>
    <message>
        <source>there is not enough memory for it</source>
        <translation>dafür reicht der Speicher nicht</translation>
    </message>
    <message>
        <source>an error inside the program: %1</source>
        <translation>ein Fehler im Programm: %1</translation>
    </message>
    <message>
        <source>an error inside the program</source>
        <translation>ein Fehler im Programm</translation>
    </message>
</context>
<context>
    <name>FrameParts</name>
    <message>
        <source>integrate</source>
        <translation>bewegen</translation>
    </message>
    <message>
        <source>broad-phase</source>
        <translation>Grobphase</translation>
    </message>
    <message>
        <source>narrow-phase</source>
        <translation>Feinphase</translation>
    </message>
    <message>
        <source>respond</source>
        <translation>antworten</translation>
    </message>
    <message>
        <source>other</source>
        <translation>Übriges</translation>
    </message>
    <message>
        <source>render</source>
        <translation>zeichnen</translation>
    </message>
    <message>
        <source>total</source>
        <translation>gesamt</translation>
    </message>
    <message>
        <source>step</source>
        <translation>Schritt</translation>
    </message>
</context>
<context>
    <name>GasCharts</name>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>Maxwell</source>
        <translation>Maxwell</translation>
    </message>
    <message>
        <source>Speeds of %1 balls</source>
        <translation>Geschwindigkeiten von %1 Kugeln</translation>
    </message>
    <message>
        <source>speed in units of √(kT/m)</source>
        <translation>Geschwindigkeit in Einheiten von √(kT/m)</translation>
    </message>
    <message>
        <source>share a unit</source>
        <translation>Anteil je Einheit</translation>
    </message>
    <message>
        <source>of each batch</source>
        <translation>jedes Abschnitts</translation>
    </message>
    <message>
        <source>mean of all so far</source>
        <translation>Mittel aller bisher</translation>
    </message>
    <message>
        <source>Compressibility at packing %1</source>
        <translation>Kompressibilität bei Packung %1</translation>
    </message>
    <message>
        <source>batch</source>
        <translation>Abschnitt</translation>
    </message>
    <message>
        <source>Z = p/(n kT)</source>
        <translation>Z = p/(n kT)</translation>
    </message>
    <message>
        <source>Carnahan and Starling</source>
        <translation>Carnahan und Starling</translation>
    </message>
    <message>
        <source>barometric formula</source>
        <translation>barometrische Höhenformel</translation>
    </message>
    <message>
        <source>Heights of %1 balls</source>
        <translation>Höhen von %1 Kugeln</translation>
    </message>
    <message>
        <source>height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>balls a metre</source>
        <translation>Kugeln je Meter</translation>
    </message>
</context>
<context>
    <name>Plot</name>
    <message>
        <source>`%1` has no ending of a chart; name it .png, .svg or .pdf</source>
        <translation>„%1“ hat keine Endung eines Diagramms; richtig wäre .png, .svg oder .pdf</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>kein Wert</translation>
    </message>
</context>
<context>
    <name>Save</name>
    <message>
        <source>“%1” exists already. Replace it?</source>
        <translation>„%1“ gibt es schon. Ersetzen?</translation>
    </message>
</context>
<context>
    <name>SweepCharts</name>
    <message>
        <source>%1 runs a point</source>
        <translation>%1 Läufe je Punkt</translation>
    </message>
    <message>
        <source>%1, median</source>
        <translation>%1, Median</translation>
    </message>
    <message>
        <source>line: median, bands: half of the runs, and nine of ten</source>
        <translation>Linie: Median, Bänder: die Hälfte der Läufe, und neun von zehn</translation>
    </message>
    <message>
        <source>no run gave a value</source>
        <translation>kein Lauf ergab einen Wert</translation>
    </message>
</context>
<context>
    <name>carom</name>
    <message>
        <source>`%1` cannot be written: %2</source>
        <translation>„%1“ kann nicht geschrieben werden: %2</translation>
    </message>
    <message>
        <source>there is no picture</source>
        <translation>es gibt kein Bild</translation>
    </message>
</context>
<context>
    <name>carom::AccuracyDock</name>
    <message>
        <source>Accuracy</source>
        <translation>Genauigkeit</translation>
    </message>
    <message>
        <source>Run it</source>
        <translation>Damit laufen</translation>
    </message>
    <message>
        <source>Use this setting</source>
        <translation>Einstellung übernehmen</translation>
    </message>
    <message>
        <source>Vary</source>
        <translation>Variieren</translation>
    </message>
    <message>
        <source>Which methods and integrators are compared</source>
        <translation>Welche Methoden und Integratoren verglichen werden</translation>
    </message>
    <message>
        <source>Simulated time</source>
        <translation>Simulierte Zeit</translation>
    </message>
    <message>
        <source>How long the scene is simulated in each run</source>
        <translation>Wie lange die Szene in jedem Lauf simuliert wird</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Show this study together with the next one</source>
        <translation>Diese Studie zusammen mit der nächsten zeigen</translation>
    </message>
    <message>
        <source>Run the scene with this setting, from its start</source>
        <translation>Die Szene mit dieser Einstellung von vorn laufen lassen</translation>
    </message>
    <message>
        <source>Write this setting into the scene&apos;s `simulation` declaration</source>
        <translation>Diese Einstellung in die Deklaration „simulation“ der Szene schreiben</translation>
    </message>
    <message>
        <source>running with %1</source>
        <translation>läuft mit %1</translation>
    </message>
    <message>
        <source>%1 is now the scene&apos;s own setting</source>
        <translation>%1 ist jetzt die Einstellung der Szene</translation>
    </message>
    <message>
        <source>Methods</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Integrators</source>
        <translation>Integratoren</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Study</source>
        <translation>Untersuchen</translation>
    </message>
    <message>
        <source>Show what was computed so far</source>
        <translation>Zeigen, was bisher gerechnet wurde</translation>
    </message>
    <message>
        <source>Run the scene with every setting chosen</source>
        <translation>Die Szene mit jeder gewählten Einstellung laufen lassen</translation>
    </message>
    <message>
        <source>Nothing in the scene can move</source>
        <translation>Nichts in der Szene kann sich bewegen</translation>
    </message>
    <message>
        <source>computing the reference solution</source>
        <translation>berechnet die Referenzlösung</translation>
    </message>
    <message>
        <source>

Click a point to choose it.</source>
        <translation>

Ein Klick auf einen Punkt wählt ihn.</translation>
    </message>
    <message>
        <source>accuracy of %1 studied in %2 s: %3</source>
        <translation>Genauigkeit von %1 in %2 s untersucht: %3</translation>
    </message>
    <message>
        <source>nothing was studied yet; choose Study first</source>
        <translation>noch wurde nichts untersucht; zuerst „Untersuchen“ wählen</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Take the study up where it was stopped</source>
        <translation>Die Studie dort aufnehmen, wo sie angehalten wurde</translation>
    </message>
    <message>
        <source>kept</source>
        <translation>behalten</translation>
    </message>
    <message>
        <source>over</source>
        <translation>über</translation>
    </message>
    <message>
        <source>A study runs the scene with every method, integrator and number of substeps and shows what each error costs in time.
Choose Study to begin; the simulation above goes on meanwhile.</source>
        <translation>Eine Studie lässt die Szene mit jeder Methode, jedem Integrator und jeder Zahl von Teilschritten laufen und zeigt, was jeder Fehler an Zeit kostet.
„Untersuchen“ beginnt sie; die Simulation oben geht dabei weiter.</translation>
    </message>
    <message>
        <source>%1 s of at most %2 s</source>
        <translation>%1 s von höchstens %2 s</translation>
    </message>
    <message>
        <source>Time for the study</source>
        <translation>Zeit für die Studie</translation>
    </message>
    <message>
        <source>About the study</source>
        <translation>Zur Studie</translation>
    </message>
    <message>
        <source>How long the study may take; what does not fit is left out</source>
        <translation>Wie lange die Studie dauern darf; was nicht hineinpasst, entfällt</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Maß</translation>
    </message>
    <message>
        <source>What the diagram has across</source>
        <translation>Was das Diagramm waagerecht zeigt</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatisch</translation>
    </message>
    <message>
        <source>within</source>
        <translation>binnen</translation>
    </message>
    <message>
        <source>studied in %1 s</source>
        <translation>in %1 s untersucht</translation>
    </message>
    <message>
        <source>stopped after %1 s</source>
        <translation>nach %1 s angehalten</translation>
    </message>
    <message>
        <source>Other engines</source>
        <translation>Andere Engines</translation>
    </message>
    <message>
        <source>Run the scene in this engine, too, with its own rules and tuned to ours</source>
        <translation>Die Szene auch in dieser Engine rechnen, mit deren Regeln und auf unsere abgestimmt</translation>
    </message>
</context>
<context>
    <name>carom::Actions</name>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Text</source>
        <translation>&amp;Text</translation>
    </message>
    <message>
        <source>&amp;Simulation</source>
        <translation>&amp;Simulation</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>&amp;New</source>
        <translation>&amp;Neu</translation>
    </message>
    <message>
        <source>Begin an empty scene</source>
        <translation>Eine leere Szene beginnen</translation>
    </message>
    <message>
        <source>New from a &amp;template or generator…</source>
        <translation>Neu aus &amp;Vorlage oder Generator …</translation>
    </message>
    <message>
        <source>Begin with a template, or with a scene made by a generator</source>
        <translation>Mit einer Vorlage oder einer erzeugten Szene beginnen</translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation>Ö&amp;ffnen …</translation>
    </message>
    <message>
        <source>Open a scene file</source>
        <translation>Eine Szenendatei öffnen</translation>
    </message>
    <message>
        <source>Open &amp;recent</source>
        <translation>&amp;Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>Open one of the scenes opened last</source>
        <translation>Eine der zuletzt geöffneten Szenen öffnen</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Speichern</translation>
    </message>
    <message>
        <source>Write the scene to its file</source>
        <translation>Die Szene in ihre Datei schreiben</translation>
    </message>
    <message>
        <source>Save &amp;as…</source>
        <translation>Speichern &amp;unter …</translation>
    </message>
    <message>
        <source>Write the scene to another file</source>
        <translation>Die Szene in eine andere Datei schreiben</translation>
    </message>
    <message>
        <source>Re&amp;load</source>
        <translation>Neu &amp;laden</translation>
    </message>
    <message>
        <source>Read the file again and give up what was changed here</source>
        <translation>Die Datei noch einmal lesen und die Änderungen hier aufgeben</translation>
    </message>
    <message>
        <source>Save &amp;picture…</source>
        <translation>&amp;Bild speichern …</translation>
    </message>
    <message>
        <source>Save the window as a PNG file</source>
        <translation>Das Fenster als PNG-Datei speichern</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>Leave the program</source>
        <translation>Das Programm verlassen</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>Take the last change back</source>
        <translation>Die letzte Änderung zurücknehmen</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>Make the change again that was taken back</source>
        <translation>Die zurückgenommene Änderung wieder vornehmen</translation>
    </message>
    <message>
        <source>Cu&amp;t</source>
        <translation>&amp;Ausschneiden</translation>
    </message>
    <message>
        <source>Move the selection to the clipboard</source>
        <translation>Die Auswahl in die Zwischenablage verschieben</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Kopieren</translation>
    </message>
    <message>
        <source>Copy the selection to the clipboard</source>
        <translation>Die Auswahl in die Zwischenablage kopieren</translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation>&amp;Einfügen</translation>
    </message>
    <message>
        <source>Insert what the clipboard holds</source>
        <translation>Den Inhalt der Zwischenablage einfügen</translation>
    </message>
    <message>
        <source>Select &amp;all</source>
        <translation>A&amp;lles auswählen</translation>
    </message>
    <message>
        <source>Select the whole text</source>
        <translation>Den ganzen Text auswählen</translation>
    </message>
    <message>
        <source>&amp;Find and replace…</source>
        <translation>&amp;Suchen und ersetzen …</translation>
    </message>
    <message>
        <source>Search the text, also with regular expressions</source>
        <translation>Den Text durchsuchen, auch mit regulären Ausdrücken</translation>
    </message>
    <message>
        <source>Find ne&amp;xt</source>
        <translation>&amp;Nächste Fundstelle</translation>
    </message>
    <message>
        <source>Go to the next place that matches</source>
        <translation>Zur nächsten passenden Stelle gehen</translation>
    </message>
    <message>
        <source>Find pre&amp;vious</source>
        <translation>&amp;Vorige Fundstelle</translation>
    </message>
    <message>
        <source>Go to the place before that matches</source>
        <translation>Zur vorigen passenden Stelle gehen</translation>
    </message>
    <message>
        <source>&amp;Go to line…</source>
        <translation>&amp;Gehe zu Zeile …</translation>
    </message>
    <message>
        <source>Put the caret on a line by its number</source>
        <translation>Die Schreibmarke auf eine Zeile setzen</translation>
    </message>
    <message>
        <source>Pr&amp;eferences…</source>
        <translation>E&amp;instellungen …</translation>
    </message>
    <message>
        <source>C&amp;omplete</source>
        <translation>&amp;Vervollständigen</translation>
    </message>
    <message>
        <source>List what may stand at the caret</source>
        <translation>Zeigen, was an der Schreibmarke stehen darf</translation>
    </message>
    <message>
        <source>Show the parameters of the declaration one is writing</source>
        <translation>Die Parameter der Deklaration zeigen, die man schreibt</translation>
    </message>
    <message>
        <source>&amp;Insert a declaration</source>
        <translation>Deklaration &amp;einfügen</translation>
    </message>
    <message>
        <source>Insert a whole declaration; Tab goes from value to value</source>
        <translation>Eine ganze Deklaration einfügen; Tab geht von Wert zu Wert</translation>
    </message>
    <message>
        <source>Go to the &amp;definition</source>
        <translation>Zur &amp;Definition</translation>
    </message>
    <message>
        <source>Go to the body whose label is at the caret</source>
        <translation>Zum Körper gehen, dessen Name an der Schreibmarke steht</translation>
    </message>
    <message>
        <source>&amp;Rename the label…</source>
        <translation>Namen &amp;ändern …</translation>
    </message>
    <message>
        <source>Give the label at the caret another name wherever it stands</source>
        <translation>Dem Namen an der Schreibmarke überall einen anderen geben</translation>
    </message>
    <message>
        <source>Toggle co&amp;mment</source>
        <translation>&amp;Kommentar umschalten</translation>
    </message>
    <message>
        <source>Comment the selected lines out, or in again</source>
        <translation>Die gewählten Zeilen aus- oder wieder einkommentieren</translation>
    </message>
    <message>
        <source>&amp;Format the text</source>
        <translation>Text &amp;ordnen</translation>
    </message>
    <message>
        <source>&amp;Next problem</source>
        <translation>&amp;Nächstes Problem</translation>
    </message>
    <message>
        <source>Go to the next problem in the text</source>
        <translation>Zum nächsten Problem im Text gehen</translation>
    </message>
    <message>
        <source>P&amp;revious problem</source>
        <translation>Vori&amp;ges Problem</translation>
    </message>
    <message>
        <source>Go to the problem before the caret</source>
        <translation>Zum Problem vor der Schreibmarke gehen</translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation>&amp;Abspielen</translation>
    </message>
    <message>
        <source>Run the simulation, or pause it</source>
        <translation>Die Simulation laufen lassen oder anhalten</translation>
    </message>
    <message>
        <source>&amp;Step</source>
        <translation>&amp;Schritt</translation>
    </message>
    <message>
        <source>Simulate one frame</source>
        <translation>Ein Bild simulieren</translation>
    </message>
    <message>
        <source>&amp;Reset</source>
        <translation>Z&amp;urücksetzen</translation>
    </message>
    <message>
        <source>Go back to the beginning, with the text as it is now</source>
        <translation>Zum Anfang zurück, mit dem Text, wie er jetzt ist</translation>
    </message>
    <message>
        <source>&amp;Faster</source>
        <translation>S&amp;chneller</translation>
    </message>
    <message>
        <source>Double the speed of the presentation</source>
        <translation>Die Geschwindigkeit der Darstellung verdoppeln</translation>
    </message>
    <message>
        <source>S&amp;lower</source>
        <translation>&amp;Langsamer</translation>
    </message>
    <message>
        <source>Halve the speed of the presentation</source>
        <translation>Die Geschwindigkeit der Darstellung halbieren</translation>
    </message>
    <message>
        <source>Real &amp;time</source>
        <translation>&amp;Echtzeit</translation>
    </message>
    <message>
        <source>One second of the scene in one second</source>
        <translation>Eine Sekunde der Szene in einer Sekunde</translation>
    </message>
    <message>
        <source>As fast as &amp;possible</source>
        <translation>So schnell wie &amp;möglich</translation>
    </message>
    <message>
        <source>Simulate without waiting for the clock</source>
        <translation>Simulieren, ohne auf die Uhr zu warten</translation>
    </message>
    <message>
        <source>&amp;Frame the selection</source>
        <translation>&amp;Auswahl einrahmen</translation>
    </message>
    <message>
        <source>Bring the selected body into view (F in the viewport)</source>
        <translation>Den gewählten Körper ins Bild bringen (F im Bild)</translation>
    </message>
    <message>
        <source>Frame &amp;everything</source>
        <translation>A&amp;lles einrahmen</translation>
    </message>
    <message>
        <source>Bring the whole scene into view (Home in the viewport)</source>
        <translation>Die ganze Szene ins Bild bringen (Pos1 im Bild)</translation>
    </message>
    <message>
        <source>World &amp;axes</source>
        <translation>&amp;Weltachsen</translation>
    </message>
    <message>
        <source>Draw the world&apos;s axes: x red, y green, z blue</source>
        <translation>Die Achsen der Welt zeichnen: x rot, y grün, z blau</translation>
    </message>
    <message>
        <source>&amp;Boxes</source>
        <translation>&amp;Quader</translation>
    </message>
    <message>
        <source>Draw the box that the broad-phase sees of each body</source>
        <translation>Den Quader zeichnen, den die Grobphase von jedem Körper sieht</translation>
    </message>
    <message>
        <source>Overlapping &amp;pairs</source>
        <translation>Überlappende &amp;Paare</translation>
    </message>
    <message>
        <source>Draw the boxes that overlap and a line between their bodies</source>
        <translation>Überlappende Quader zeichnen und eine Linie zwischen ihren Körpern</translation>
    </message>
    <message>
        <source>&amp;Grid cells or tree nodes</source>
        <translation>&amp;Gitterzellen oder Baumknoten</translation>
    </message>
    <message>
        <source>Draw the cells of the grid or the nodes of the tree that the broad-phase uses</source>
        <translation>Die Zellen des Gitters oder die Knoten des Baums zeichnen, die die Grobphase benutzt</translation>
    </message>
    <message>
        <source>&amp;Velocities</source>
        <translation>&amp;Geschwindigkeiten</translation>
    </message>
    <message>
        <source>Draw the way of each body in a tenth of a second</source>
        <translation>Den Weg jedes Körpers in einer Zehntelsekunde zeichnen</translation>
    </message>
    <message>
        <source>&amp;Contacts</source>
        <translation>&amp;Kontakte</translation>
    </message>
    <message>
        <source>&amp;Labels</source>
        <translation>&amp;Namen</translation>
    </message>
    <message>
        <source>Write the labels of bodies over them</source>
        <translation>Die Namen der Körper über sie schreiben</translation>
    </message>
    <message>
        <source>&amp;Write</source>
        <translation>&amp;Schreiben</translation>
    </message>
    <message>
        <source>Arrange the panels for writing a scene</source>
        <translation>Die Felder zum Schreiben einer Szene anordnen</translation>
    </message>
    <message>
        <source>Wat&amp;ch</source>
        <translation>&amp;Zusehen</translation>
    </message>
    <message>
        <source>Arrange the panels for watching: a large picture</source>
        <translation>Die Felder zum Zusehen anordnen: ein großes Bild</translation>
    </message>
    <message>
        <source>M&amp;easure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Arrange the panels for measuring times and quantities</source>
        <translation>Die Felder zum Messen von Zeiten und Größen anordnen</translation>
    </message>
    <message>
        <source>Stud&amp;y</source>
        <translation>&amp;Untersuchen</translation>
    </message>
    <message>
        <source>Arrange the panels for studies of accuracy and cost</source>
        <translation>Die Felder für Untersuchungen von Genauigkeit und Aufwand anordnen</translation>
    </message>
    <message>
        <source>Larger te&amp;xt</source>
        <translation>&amp;Größerer Text</translation>
    </message>
    <message>
        <source>Make the editor&apos;s text larger</source>
        <translation>Den Text größer machen</translation>
    </message>
    <message>
        <source>S&amp;maller text</source>
        <translation>&amp;Kleinerer Text</translation>
    </message>
    <message>
        <source>Make the editor&apos;s text smaller</source>
        <translation>Den Text kleiner machen</translation>
    </message>
    <message>
        <source>&amp;Normal text</source>
        <translation>N&amp;ormaler Text</translation>
    </message>
    <message>
        <source>Show each problem&apos;s message under its line</source>
        <translation>Die Meldung jedes Problems unter seiner Zeile zeigen</translation>
    </message>
    <message>
        <source>&amp;Dark theme</source>
        <translation>&amp;Dunkle Farben</translation>
    </message>
    <message>
        <source>Switch between the dark and the light theme</source>
        <translation>Zwischen dunklen und hellen Farben wechseln</translation>
    </message>
    <message>
        <source>&amp;Collapse the panels below</source>
        <translation>Untere Felder ein&amp;klappen</translation>
    </message>
    <message>
        <source>Leave only the tabs of the panels below, and more of text and picture; a click on a tab brings them back</source>
        <translation>Von den unteren Feldern nur die Reiter lassen, für mehr Text und Bild; ein Klick auf einen Reiter holt sie zurück</translation>
    </message>
    <message>
        <source>Go to the e&amp;ditor</source>
        <translation>Zum &amp;Text gehen</translation>
    </message>
    <message>
        <source>Put the keyboard into the text</source>
        <translation>Die Tastatur in den Text setzen</translation>
    </message>
    <message>
        <source>Go to the vie&amp;wport</source>
        <translation>Zum &amp;Bild gehen</translation>
    </message>
    <message>
        <source>Put the keyboard into the picture</source>
        <translation>Die Tastatur ins Bild setzen</translation>
    </message>
    <message>
        <source>&amp;Manual: the word at the caret</source>
        <translation>&amp;Handbuch: das Wort an der Schreibmarke</translation>
    </message>
    <message>
        <source>Open the manual at what the word at the caret means</source>
        <translation>Das Handbuch beim Wort an der Schreibmarke öffnen</translation>
    </message>
    <message>
        <source>&amp;Tutorial</source>
        <translation>&amp;Einführung</translation>
    </message>
    <message>
        <source>From an empty scene to a measured answer in ten minutes</source>
        <translation>In zehn Minuten von der leeren Szene zur gemessenen Antwort</translation>
    </message>
    <message>
        <source>&amp;Welcome…</source>
        <translation>&amp;Willkommen …</translation>
    </message>
    <message>
        <source>Show the gallery of scenes and the files opened last</source>
        <translation>Die Galerie der Szenen und die zuletzt geöffneten Dateien zeigen</translation>
    </message>
    <message>
        <source>&amp;Find a command…</source>
        <translation>&amp;Befehl suchen …</translation>
    </message>
    <message>
        <source>Do anything the menus can do, by a few letters of its name</source>
        <translation>Alles tun, was die Menüs können, mit wenigen Buchstaben seines Namens</translation>
    </message>
    <message>
        <source>&amp;About Carom</source>
        <translation>Ü&amp;ber Carom</translation>
    </message>
    <message>
        <source>Version and licence</source>
        <translation>Version und Lizenz</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Step &amp;back</source>
        <translation>Schritt &amp;zurück</translation>
    </message>
    <message>
        <source>Go back one frame</source>
        <translation>Ein Bild zurückgehen</translation>
    </message>
    <message>
        <source>&amp;Trails</source>
        <translation>&amp;Spuren</translation>
    </message>
    <message>
        <source>Draw the way each body has come in the last states shown</source>
        <translation>Den Weg zeichnen, den jeder Körper zuletzt genommen hat</translation>
    </message>
    <message>
        <source>Centre of &amp;mass</source>
        <translation>&amp;Schwerpunkt</translation>
    </message>
    <message>
        <source>Mark the centre of mass of everything that moves</source>
        <translation>Den Schwerpunkt von allem Beweglichen zeigen</translation>
    </message>
    <message>
        <source>G&amp;host of the run before</source>
        <translation>S&amp;chatten des vorigen Laufs</translation>
    </message>
    <message>
        <source>After an edit in the middle of a run, draw where the bodies were before it</source>
        <translation>Nach einer Änderung mitten im Lauf zeigen, wo die Körper vorher waren</translation>
    </message>
    <message>
        <source>Save the &amp;view…</source>
        <translation>&amp;Ansicht speichern …</translation>
    </message>
    <message>
        <source>Save the picture of the scene as a PNG file of any size</source>
        <translation>Das Bild der Szene als PNG-Datei beliebiger Größe speichern</translation>
    </message>
    <message>
        <source>Choose an event at which the run stops: a contact, a speed, a plane crossed</source>
        <translation>Ein Ereignis wählen, bei dem der Lauf anhält: ein Kontakt, eine Geschwindigkeit, eine Ebene</translation>
    </message>
    <message>
        <source>Go back to the last frame at which a breakpoint held</source>
        <translation>Zum letzten Bild zurück, bei dem ein Haltepunkt galt</translation>
    </message>
    <message>
        <source>Write the present view into the camera declaration of the text</source>
        <translation>Die jetzige Ansicht in die Kamera des Textes schreiben</translation>
    </message>
    <message>
        <source>Draw points, normals and forces where bodies touch</source>
        <translation>Punkte, Normalen und Kräfte zeichnen, wo Körper sich berühren</translation>
    </message>
    <message>
        <source>&amp;Overlays</source>
        <translation>&amp;Einblendungen</translation>
    </message>
    <message>
        <source>Wo&amp;rkspace</source>
        <translation>A&amp;rbeitsbereich</translation>
    </message>
    <message>
        <source>Messages &amp;in the text</source>
        <translation>Meldungen &amp;im Text</translation>
    </message>
    <message>
        <source>&amp;Cancel the build</source>
        <translation>Aufbau a&amp;bbrechen</translation>
    </message>
    <message>
        <source>Stop building a long text; what was on screen stays there until the next edit</source>
        <translation>Den Aufbau eines langen Textes abbrechen; bis zur nächsten Änderung bleibt zu sehen, was zu sehen war</translation>
    </message>
    <message>
        <source>Record a vi&amp;deo…</source>
        <translation>Vi&amp;deo aufnehmen …</translation>
    </message>
    <message>
        <source>Record the run as an animated picture, a video or single pictures</source>
        <translation>Den Lauf als animiertes Bild, Video oder Einzelbilder aufnehmen</translation>
    </message>
    <message>
        <source>Select the next &amp;occurrence</source>
        <translation>Nächstes V&amp;orkommen auswählen</translation>
    </message>
    <message>
        <source>Select the word at the caret, and then where it stands next as well (Ctrl+click adds a caret)</source>
        <translation>Das Wort am Cursor auswählen, danach auch sein nächstes Vorkommen (Strg+Klick setzt einen weiteren Cursor)</translation>
    </message>
    <message>
        <source>Move the line u&amp;p</source>
        <translation>Zeile nach o&amp;ben schieben</translation>
    </message>
    <message>
        <source>Move the selected lines up by one</source>
        <translation>Die ausgewählten Zeilen um eine nach oben schieben</translation>
    </message>
    <message>
        <source>Move the line do&amp;wn</source>
        <translation>Zeile nach &amp;unten schieben</translation>
    </message>
    <message>
        <source>Move the selected lines down by one</source>
        <translation>Die ausgewählten Zeilen um eine nach unten schieben</translation>
    </message>
    <message>
        <source>Theme, font, shortcuts, navigation, memory and threads</source>
        <translation>Farben, Schrift, Tastenkürzel, Navigation, Speicher und Threads</translation>
    </message>
    <message>
        <source>&amp;Parameter hints</source>
        <translation>&amp;Parameterhinweise</translation>
    </message>
    <message>
        <source>Increase val&amp;ue</source>
        <translation>Wert er&amp;höhen</translation>
    </message>
    <message>
        <source>Increase the number at the caret by one step (Alt+wheel and Alt+drag, too)</source>
        <translation>Die Zahl am Cursor um einen Schritt erhöhen (auch Alt+Rad und Alt+Ziehen)</translation>
    </message>
    <message>
        <source>Decrease &amp;value</source>
        <translation>Wert &amp;verringern</translation>
    </message>
    <message>
        <source>Decrease the number at the caret by one step (Alt+wheel and Alt+drag, too)</source>
        <translation>Die Zahl am Cursor um einen Schritt verringern (auch Alt+Rad und Alt+Ziehen)</translation>
    </message>
    <message>
        <source>Format the whole text; only white space changes</source>
        <translation>Den ganzen Text formatieren; nur Leerraum ändert sich</translation>
    </message>
    <message>
        <source>Quick f&amp;ix</source>
        <translation>Schnellkorrekt&amp;ur</translation>
    </message>
    <message>
        <source>Correct the problem at the caret</source>
        <translation>Das Problem am Cursor beheben</translation>
    </message>
    <message>
        <source>Br&amp;eakpoints…</source>
        <translation>&amp;Haltepunkte …</translation>
    </message>
    <message>
        <source>Back to the last brea&amp;kpoint</source>
        <translation>Zurück zum le&amp;tzten Haltepunkt</translation>
    </message>
    <message>
        <source>In&amp;sert camera</source>
        <translation>&amp;Kamera einfügen</translation>
    </message>
    <message>
        <source>Give the editor&apos;s text its default size</source>
        <translation>Dem Text im Editor die Standardgröße geben</translation>
    </message>
    <message>
        <source>F&amp;old or unfold all</source>
        <translation>Alles &amp;falten oder entfalten</translation>
    </message>
    <message>
        <source>Show only the first line of every declaration, or all of them</source>
        <translation>Von jeder Deklaration nur die erste Zeile zeigen, oder alle</translation>
    </message>
    <message>
        <source>Wrap lon&amp;g lines</source>
        <translation>Lange &amp;Zeilen umbrechen</translation>
    </message>
    <message>
        <source>Show the rest of a line that is too long below it; the text stays as it is</source>
        <translation>Den Rest einer zu langen Zeile darunter zeigen; der Text bleibt, wie er ist</translation>
    </message>
    <message>
        <source>Reset wor&amp;kspace</source>
        <translation>Arbeitsbereich &amp;zurücksetzen</translation>
    </message>
    <message>
        <source>Arrange the panels of this workspace as at first</source>
        <translation>Die Bereiche wie am Anfang anordnen</translation>
    </message>
    <message>
        <source>Shortcu&amp;ts</source>
        <translation>&amp;Tastenkürzel</translation>
    </message>
    <message>
        <source>All shortcuts and what they do</source>
        <translation>Alle Tastenkürzel und was sie tun</translation>
    </message>
    <message>
        <source>&amp;Look from</source>
        <translation>&amp;Blicken von</translation>
    </message>
    <message>
        <source>&amp;Why did this happen?</source>
        <translation>&amp;Warum geschah das?</translation>
    </message>
    <message>
        <source>Name and show the two bodies of the largest impact in the frame on screen (a click on a mark of the timeline does it, too)</source>
        <translation>Die zwei Körper des größten Stoßes im gezeigten Bild nennen und zeigen (auch ein Klick auf eine Marke der Zeitleiste)</translation>
    </message>
    <message>
        <source>Stop where energy rises</source>
        <translation>Anhalten, wo die Energie steigt</translation>
    </message>
    <message>
        <source>Pause a run whose energy rises from nowhere, as it does where a step is too long for what it has to follow</source>
        <translation>Einen Lauf anhalten, dessen Energie aus dem Nichts steigt, wie bei einem Schritt, der für das zu lang ist, dem er folgen soll</translation>
    </message>
    <message>
        <source>&amp;Top</source>
        <translation>&amp;Oben</translation>
    </message>
    <message>
        <source>Look from above (7 of the number pad in the viewport)</source>
        <translation>Von oben blicken (7 des Ziffernblocks im Bild)</translation>
    </message>
    <message>
        <source>&amp;Bottom</source>
        <translation>&amp;Unten</translation>
    </message>
    <message>
        <source>Look from below</source>
        <translation>Von unten blicken</translation>
    </message>
    <message>
        <source>&amp;Front</source>
        <translation>&amp;Vorn</translation>
    </message>
    <message>
        <source>Look along the z axis (1 of the number pad in the viewport)</source>
        <translation>Entlang der z-Achse blicken (1 des Ziffernblocks im Bild)</translation>
    </message>
    <message>
        <source>Bac&amp;k</source>
        <translation>&amp;Hinten</translation>
    </message>
    <message>
        <source>Look along the z axis from behind</source>
        <translation>Von hinten entlang der z-Achse blicken</translation>
    </message>
    <message>
        <source>&amp;Right</source>
        <translation>&amp;Rechts</translation>
    </message>
    <message>
        <source>Look along the x axis from the right (3 of the number pad in the viewport)</source>
        <translation>Von rechts entlang der x-Achse blicken (3 des Ziffernblocks im Bild)</translation>
    </message>
    <message>
        <source>&amp;Left</source>
        <translation>&amp;Links</translation>
    </message>
    <message>
        <source>Look along the x axis from the left</source>
        <translation>Von links entlang der x-Achse blicken</translation>
    </message>
    <message>
        <source>&amp;Orthographic</source>
        <translation>O&amp;rthografisch</translation>
    </message>
    <message>
        <source>Show the scene without perspective (5 of the number pad in the viewport)</source>
        <translation>Die Szene ohne Perspektive zeigen (5 des Ziffernblocks im Bild)</translation>
    </message>
    <message>
        <source>C&amp;hecks…</source>
        <translation>&amp;Prüfungen…</translation>
    </message>
    <message>
        <source>Show what the scene expects of its run, and how it fares</source>
        <translation>Zeigt, was die Szene von ihrem Lauf erwartet und wie es darum steht</translation>
    </message>
    <message>
        <source>Ra&amp;ce…</source>
        <translation>&amp;Wettlauf…</translation>
    </message>
    <message>
        <source>Run the scene twice, with two settings or two texts, and see how the runs part</source>
        <translation>Die Szene zweimal laufen lassen, mit zwei Einstellungen oder zwei Texten, und sehen, wie sich die Läufe trennen</translation>
    </message>
    <message>
        <source>Choose a co&amp;lour…</source>
        <translation>Fa&amp;rbe wählen…</translation>
    </message>
    <message>
        <source>Choose another colour in place of the one at the caret (the square beside it does it, too)</source>
        <translation>Eine andere Farbe anstelle der an der Schreibmarke wählen (das Quadrat daneben tut es auch)</translation>
    </message>
    <message>
        <source>S&amp;weep the value at the caret…</source>
        <translation>Den Wert an der Einfügemarke &amp;variieren …</translation>
    </message>
    <message>
        <source>Run the scene with a range of values in the place of the number at the caret, and measure each run</source>
        <translation>Die Szene mit mehreren Werten anstelle der Zahl an der Einfügemarke laufen lassen und jeden Lauf messen</translation>
    </message>
</context>
<context>
    <name>carom::BreakpointsDock</name>
    <message>
        <source>Breakpoints</source>
        <translation>Haltepunkte</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Stop the run when this happens</source>
        <translation>Den Lauf anhalten, wenn dies geschieht</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Forget the selected breakpoint</source>
        <translation>Den gewählten Haltepunkt vergessen</translation>
    </message>
    <message>
        <source>Back to the last one</source>
        <translation>Zum letzten zurück</translation>
    </message>
    <message>
        <source>Go back to the last frame before this one at which a breakpoint held (Shift+F9)</source>
        <translation>Zum letzten Bild vor diesem zurückgehen, bei dem ein Haltepunkt zutraf (Umschalt+F9)</translation>
    </message>
    <message>
        <source>Event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>Körper</translation>
    </message>
    <message>
        <source>Other body</source>
        <translation>Anderer Körper</translation>
    </message>
    <message>
        <source>stop at</source>
        <translation>anhalten bei</translation>
    </message>
    <message>
        <source>of</source>
        <translation>von</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>any body</source>
        <translation>irgendein Körper</translation>
    </message>
    <message>
        <source>limit</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>contact of %1 and %2</source>
        <translation>Kontakt von %1 und %2</translation>
    </message>
    <message>
        <source>penetration over %1 m</source>
        <translation>Eindringen über %1 m</translation>
    </message>
    <message>
        <source>energy drift over %1</source>
        <translation>Energiefehler über %1</translation>
    </message>
    <message>
        <source>%1 faster than %2 m/s</source>
        <translation>%1 schneller als %2 m/s</translation>
    </message>
    <message>
        <source>%1 crosses %2 = %3 m</source>
        <translation>%1 kreuzt %2 = %3 m</translation>
    </message>
    <message>
        <source>Choose an event at the left and press Add: the run stops when it happens.
Shift+F9 finds the last one backwards.</source>
        <translation>Links ein Ereignis wählen und „Hinzufügen“ drücken: der Lauf hält an, wenn es eintritt.
Umschalt+F9 findet das letzte rückwärts.</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Limit</source>
        <translation>Grenze</translation>
    </message>
</context>
<context>
    <name>carom::BroadphaseComparison</name>
    <message>
        <source>What to compare on</source>
        <translation>Worauf verglichen wird</translation>
    </message>
    <message>
        <source>on this scene</source>
        <translation>auf dieser Szene</translation>
    </message>
    <message>
        <source>Its first %1 frames with every algorithm</source>
        <translation>Ihre ersten %1 Bilder mit jedem Verfahren</translation>
    </message>
    <message>
        <source>against N: %1</source>
        <translation>über N: %1</translation>
    </message>
    <message>
        <source>%1 frames of the generated scene at growing numbers of bodies; takes minutes</source>
        <translation>%1 Bilder der erzeugten Szene mit wachsender Zahl von Körpern; dauert Minuten</translation>
    </message>
    <message>
        <source>Chart</source>
        <translation>Diagramm</translation>
    </message>
    <message>
        <source>Compare all runs the first %1 frames of the scene with every algorithm and shows what each took.
The simulation above goes on meanwhile.</source>
        <translation>„Alle vergleichen“ lässt die ersten %1 Bilder der Szene mit jedem Verfahren laufen und zeigt, was jedes gebraucht hat.
Die Simulation oben geht dabei weiter.</translation>
    </message>
    <message>
        <source>CSV, a row a frame…</source>
        <translation>CSV, eine Zeile je Bild …</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Compare all</source>
        <translation>Alle vergleichen</translation>
    </message>
    <message>
        <source>Show what was computed so far</source>
        <translation>Zeigen, was bisher gerechnet wurde</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>%1, about %2 s left</source>
        <translation>%1, noch etwa %2 s</translation>
    </message>
    <message>
        <source>broad-phases compared in %1 s: %2</source>
        <translation>Grobphasen in %1 s verglichen: %2</translation>
    </message>
    <message>
        <source>Stopped before there was anything to compare.</source>
        <translation>Angehalten, bevor es etwas zu vergleichen gab.</translation>
    </message>
    <message>
        <source>Median time of a step [ms] against the number of bodies N.</source>
        <translation>Median der Zeit eines Schrittes [ms] gegen die Zahl der Körper N.</translation>
    </message>
    <message>
        <source>Stopped; median time of a step [ms] as far as it went.</source>
        <translation>Angehalten; Median der Zeit eines Schrittes [ms], soweit es kam.</translation>
    </message>
    <message>
        <source>%1 frames from the start: %2 was fastest.</source>
        <translation>%1 Bilder vom Anfang: %2 war am schnellsten.</translation>
    </message>
    <message>
        <source>Stopped. </source>
        <translation>Angehalten. </translation>
    </message>
    <message>
        <source> The scene has changed since.</source>
        <translation> Die Szene hat sich seitdem geändert.</translation>
    </message>
    <message>
        <source>What each algorithm took</source>
        <translation>Was jedes Verfahren gebraucht hat</translation>
    </message>
    <message>
        <source>Means of the frames behind the first: of the broad-phase, the whole step, pairs tested, pairs overlapping, and tested for each overlapping</source>
        <translation>Mittel der Bilder nach dem ersten: der Grobphase, des ganzen Schrittes, geprüfte Paare, überlappende Paare, und geprüfte je überlappendem</translation>
    </message>
    <message>
        <source>Median time of a step [ms] behind the first</source>
        <translation>Median der Zeit eines Schrittes [ms] nach dem ersten</translation>
    </message>
    <message>
        <source>nothing was compared yet; choose Compare all first</source>
        <translation>noch wurde nichts verglichen; zuerst „Alle vergleichen“ wählen</translation>
    </message>
    <message>
        <source>there is no chart of so few figures</source>
        <translation>aus so wenigen Zahlen gibt es kein Diagramm</translation>
    </message>
    <message>
        <source>there are no single frames; compare all on this scene first</source>
        <translation>es gibt keine einzelnen Bilder; zuerst auf dieser Szene alle vergleichen</translation>
    </message>
    <message>
        <source>%1 frames from the start: no clear difference between the fastest, %2.</source>
        <translation>%1 Bilder von Anfang an: kein klarer Unterschied zwischen den schnellsten, %2.</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
</context>
<context>
    <name>carom::BroadphaseDock</name>
    <message>
        <source>Boxes</source>
        <translation>Quader</translation>
    </message>
    <message>
        <source>Boxes looked at in the frame</source>
        <translation>Quader, die im Bild angesehen wurden</translation>
    </message>
    <message>
        <source>Overlapping pairs</source>
        <translation>Überlappende Paare</translation>
    </message>
    <message>
        <source>Pairs whose boxes overlap: what the narrow phase gets</source>
        <translation>Paare, deren Quader überlappen: was die Feinphase bekommt</translation>
    </message>
    <message>
        <source>Pairs tested</source>
        <translation>Geprüfte Paare</translation>
    </message>
    <message>
        <source>Pairs of boxes compared to find them</source>
        <translation>Paare von Quadern, die dafür verglichen wurden</translation>
    </message>
    <message>
        <source>Tested / overlapping</source>
        <translation>Geprüft / überlappend</translation>
    </message>
    <message>
        <source>1 would be perfect</source>
        <translation>1 wäre vollkommen</translation>
    </message>
    <message>
        <source>Contacts</source>
        <translation>Kontakte</translation>
    </message>
    <message>
        <source>Pairs found touching or overlapping</source>
        <translation>Paare, die sich berühren oder überlappen</translation>
    </message>
    <message>
        <source>Swaps</source>
        <translation>Vertauschungen</translation>
    </message>
    <message>
        <source>Exchanges of neighbouring end points (sweep and sort)</source>
        <translation>Vertauschungen benachbarter Endpunkte (Sweep-and-Sort)</translation>
    </message>
    <message>
        <source>Pairs added / removed</source>
        <translation>Paare hinzu / fort</translation>
    </message>
    <message>
        <source>Pairs that began and ceased to overlap</source>
        <translation>Paare, die zu überlappen begannen und aufhörten</translation>
    </message>
    <message>
        <source>Cells or nodes</source>
        <translation>Zellen oder Knoten</translation>
    </message>
    <message>
        <source>Cells of a grid or nodes of a tree visited</source>
        <translation>Besuchte Zellen eines Gitters oder Knoten eines Baumes</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Speicher</translation>
    </message>
    <message>
        <source>Held by the algorithm</source>
        <translation>Was das Verfahren belegt</translation>
    </message>
    <message>
        <source>Axes tried</source>
        <translation>Achsen versucht</translation>
    </message>
    <message>
        <source>Pairs tried along the direction that parted them in the frame before</source>
        <translation>Paare, die entlang der Richtung versucht wurden, die sie im Bild davor trennte</translation>
    </message>
    <message>
        <source>Full tests spared</source>
        <translation>Ganze Tests erspart</translation>
    </message>
    <message>
        <source>Of the axes tried, those that still part the pair: no full test was needed</source>
        <translation>Von den versuchten Achsen die, die das Paar noch trennen: kein ganzer Test war nötig</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Wall time of the broad-phase in the frame</source>
        <translation>Zeit der Grobphase im Bild</translation>
    </message>
    <message>
        <source>Broad-phase</source>
        <translation>Grobphase</translation>
    </message>
    <message>
        <source>Algorithm</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>As the scene asks</source>
        <translation>Wie die Szene verlangt</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keins</translation>
    </message>
    <message>
        <source>As the scene asks (%1)</source>
        <translation>Wie die Szene verlangt (%1)</translation>
    </message>
    <message>
        <source>The scene names it.</source>
        <translation>Die Szene nennt es.</translation>
    </message>
    <message>
        <source>Chosen: %1</source>
        <translation>Gewählt: %1</translation>
    </message>
    <message>
        <source>Pairs collided</source>
        <translation>Kollidierte Paare</translation>
    </message>
    <message>
        <source>Pairs whose shapes the method of contacts compared</source>
        <translation>Paare, deren Formen die Kontaktmethode verglichen hat</translation>
    </message>
    <message>
        <source>Rows swept</source>
        <translation>Durchlaufene Zeilen</translation>
    </message>
    <message>
        <source>Contact points times passes of its velocity solve</source>
        <translation>Kontaktpunkte mal Durchläufe ihrer Geschwindigkeitslösung</translation>
    </message>
    <message>
        <source>Factorisations</source>
        <translation>Faktorisierungen</translation>
    </message>
    <message>
        <source>Of matrices of contacts, for exact forces</source>
        <translation>Von Kontaktmatrizen, für genaue Kräfte</translation>
    </message>
    <message>
        <source>Impacts</source>
        <translation>Stöße</translation>
    </message>
    <message>
        <source>Impacts solved</source>
        <translation>Gelöste Stöße</translation>
    </message>
    <message>
        <source>Searches</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>How often the broad-phase searched for the method of contacts</source>
        <translation>Wie oft die Breitphase für die Kontaktmethode gesucht hat</translation>
    </message>
    <message>
        <source>Islands</source>
        <translation>Inseln</translation>
    </message>
    <message>
        <source>Groups of bodies that touch, summed over the substeps</source>
        <translation>Gruppen sich berührender Körper, über die Teilschritte summiert</translation>
    </message>
    <message>
        <source>Islands unfinished</source>
        <translation>Unfertige Inseln</translation>
    </message>
    <message>
        <source>Islands whose forces are not exact, because the budget of the frame did not allow it</source>
        <translation>Inseln, deren Kräfte nicht genau sind, weil das Budget des Bildes es nicht erlaubt hat</translation>
    </message>
</context>
<context>
    <name>carom::Checks</name>
    <message>
        <source>asked of the preset %1 only</source>
        <translation>nur für die Voreinstellung %1 verlangt</translation>
    </message>
    <message>
        <source>not judged yet</source>
        <translation>noch nicht beurteilt</translation>
    </message>
    <message>
        <source>holds: %1</source>
        <translation>erfüllt: %1</translation>
    </message>
    <message>
        <source>did not hold: %1</source>
        <translation>nicht erfüllt: %1</translation>
    </message>
</context>
<context>
    <name>carom::ChecksDock</name>
    <message>
        <source>Checks</source>
        <translation>Prüfungen</translation>
    </message>
    <message>
        <source>Expectations</source>
        <translation>Erwartungen</translation>
    </message>
    <message>
        <source>Expected</source>
        <translation>Erwartet</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>To spare</source>
        <translation>Spielraum</translation>
    </message>
    <message>
        <source>First failed</source>
        <translation>Zuerst verfehlt</translation>
    </message>
    <message>
        <source>The scene expects nothing.
An `expect` declaration says what must come out of the run; it is judged here as the run goes on. The manual has a page about it: State what must happen.</source>
        <translation>Die Szene erwartet nichts.
Eine Deklaration `expect` sagt, was aus dem Lauf kommen muss; hier wird sie beurteilt, während er weitergeht. Im Handbuch steht dazu eine Seite: State what must happen.</translation>
    </message>
    <message>
        <source>line %1: %2</source>
        <translation>Zeile %1: %2</translation>
    </message>
    <message>
        <source>not judged yet</source>
        <translation>noch nicht beurteilt</translation>
    </message>
    <message>
        <source>holds</source>
        <translation>erfüllt</translation>
    </message>
    <message>
        <source>frame %1, %2 s</source>
        <translation>Bild %1, %2 s</translation>
    </message>
    <message>
        <source>A double click goes there</source>
        <translation>Ein Doppelklick führt dorthin</translation>
    </message>
    <message>
        <source>%1 of %2 hold, %3 failed, %4 not judged yet</source>
        <translation>%1 von %2 erfüllt, %3 verfehlt, %4 noch nicht beurteilt</translation>
    </message>
    <message>
        <source>Checks (%1 failed)</source>
        <translation>Prüfungen (%1 verfehlt)</translation>
    </message>
</context>
<context>
    <name>carom::CommandFinder</name>
    <message>
        <source>What do you want to do?</source>
        <translation>Was möchten Sie tun?</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>Commands</source>
        <translation>Befehle</translation>
    </message>
    <message>
        <source> (on)</source>
        <translation> (an)</translation>
    </message>
    <message>
        <source>Nothing is called that.</source>
        <translation>So heißt nichts.</translation>
    </message>
</context>
<context>
    <name>carom::Core</name>
    <message>
        <source>on</source>
        <translation>an</translation>
    </message>
    <message>
        <source>absent</source>
        <translation>nicht vorhanden</translation>
    </message>
    <message>
        <source>not simulated yet</source>
        <translation>noch nicht simuliert</translation>
    </message>
    <message>
        <source>%1: %2 body, too few to be worth sorting</source>
        <translation>%1: %2 Körper, zu wenige, um sie zu sortieren</translation>
    </message>
    <message>
        <source>%1: %2 bodies, too few to be worth sorting</source>
        <translation>%1: %2 Körper, zu wenige, um sie zu sortieren</translation>
    </message>
    <message>
        <source>%1: %2 bodies, of which only %3 can move</source>
        <translation>%1: %2 Körper, von denen sich nur %3 bewegen können</translation>
    </message>
    <message>
        <source>%1: %2 bodies, the wide ones %3 times the narrow ones</source>
        <translation>%1: %2 Körper, die breiten %3-mal so breit wie die schmalen</translation>
    </message>
    <message>
        <source>%1: %2 bodies lying close: %3 overlapping boxes for each</source>
        <translation>%1: %2 Körper, dicht beieinander: %3 überlappende Quader je Körper</translation>
    </message>
    <message>
        <source>%1: %2 bodies of similar size, well apart, few enough for one sweep</source>
        <translation>%1: %2 Körper ähnlicher Größe mit Abstand, wenige genug für einen einzigen Durchgang</translation>
    </message>
    <message>
        <source>%1: %2 bodies of similar size, well apart</source>
        <translation>%1: %2 Körper ähnlicher Größe mit Abstand</translation>
    </message>
    <message>
        <source>none is declared</source>
        <translation>keine Deklaration</translation>
    </message>
    <message>
        <source>its density is 0</source>
        <translation>ihre Dichte ist 0</translation>
    </message>
    <message>
        <source>nothing that can move has `drag`</source>
        <translation>nichts, was sich bewegen kann, hat `drag`</translation>
    </message>
    <message>
        <source>air of %1 kg/m³ slows %2, which has drag %3</source>
        <translation>Luft von %1 kg/m³ bremst %2 mit dem Widerstandsbeiwert %3</translation>
    </message>
    <message>
        <source>it moves as in a vacuum</source>
        <translation>bewegt wird es wie im Vakuum</translation>
    </message>
    <message>
        <source>no two bodies can meet</source>
        <translation>keine zwei Körper können sich treffen</translation>
    </message>
    <message>
        <source>the method finds by itself which bodies meet next</source>
        <translation>das Verfahren findet selbst, welche Körper sich als Nächstes treffen</translation>
    </message>
    <message>
        <source>all pairs are compared, as asked for</source>
        <translation>alle Paare werden verglichen, wie verlangt</translation>
    </message>
    <message>
        <source>%1: it is asked for</source>
        <translation>%1: so ist es verlangt</translation>
    </message>
    <message>
        <source>no body can move</source>
        <translation>kein Körper kann sich bewegen</translation>
    </message>
    <message>
        <source>there is only one body</source>
        <translation>es gibt nur einen Körper</translation>
    </message>
    <message>
        <source>%1 mobile body among %2 can meet the others</source>
        <translation>%1 beweglicher Körper von %2 kann die anderen treffen</translation>
    </message>
    <message>
        <source>%1 mobile bodies among %2 can meet the others</source>
        <translation>%1 bewegliche Körper von %2 können die anderen treffen</translation>
    </message>
    <message>
        <source>no body can pass its half-extent in a substep by the energy there is</source>
        <translation>mit der vorhandenen Energie kommt kein Körper in einem Teilschritt weiter als seine halbe Ausdehnung</translation>
    </message>
    <message>
        <source>%1 may move %2 m in a substep by the energy there is, more than its half-extent of %3 m</source>
        <translation>mit der vorhandenen Energie kann %1 in einem Teilschritt %2 m weit kommen, mehr als die halbe Ausdehnung von %3 m</translation>
    </message>
    <message>
        <source>nothing bounds the speed of %1</source>
        <translation>nichts begrenzt die Geschwindigkeit von %1</translation>
    </message>
    <message>
        <source>impacts are located within the step</source>
        <translation>Stöße werden im Schritt geortet</translation>
    </message>
    <message>
        <source>impacts are located within the step for the accuracy alone</source>
        <translation>Stöße werden nur der Genauigkeit wegen im Schritt geortet</translation>
    </message>
    <message>
        <source>the method looks at the ends of substeps only</source>
        <translation>das Verfahren sieht nur auf die Enden der Teilschritte</translation>
    </message>
    <message>
        <source>the geometric mean of the coefficients is 0 for every pair that can meet</source>
        <translation>das geometrische Mittel der Beiwerte ist 0 für jedes Paar, das sich treffen kann</translation>
    </message>
    <message>
        <source>%1 and %2 have friction</source>
        <translation>%1 und %2 haben Reibung</translation>
    </message>
    <message>
        <source>they slide without it</source>
        <translation>sie gleiten ohne sie</translation>
    </message>
    <message>
        <source>the acceleration is zero</source>
        <translation>die Beschleunigung ist null</translation>
    </message>
    <message>
        <source>the scene declares %1 m/s²</source>
        <translation>die Szene gibt %1 m/s² an</translation>
    </message>
    <message>
        <source>the scene declares no `gravity`; without one it is %1 m/s² downwards</source>
        <translation>die Szene gibt keine `gravity` an; ohne sie sind es %1 m/s² nach unten</translation>
    </message>
    <message>
        <source>no body that can turn has moments of inertia that differ</source>
        <translation>kein Körper, der sich drehen kann, hat verschiedene Trägheitsmomente</translation>
    </message>
    <message>
        <source>%1 may come to spin askew to its axes</source>
        <translation>%1 kann sich schräg zu den eigenen Achsen drehen</translation>
    </message>
    <message>
        <source>%1 spins askew to its axes</source>
        <translation>%1 dreht sich schräg zu den eigenen Achsen</translation>
    </message>
    <message>
        <source>its angular velocity precesses between impacts</source>
        <translation>die Winkelgeschwindigkeit präzediert zwischen Stößen</translation>
    </message>
    <message>
        <source>its angular velocity is kept constant between collisions, as in the reference</source>
        <translation>die Winkelgeschwindigkeit bleibt zwischen Stößen gleich, wie im Vorbild</translation>
    </message>
    <message>
        <source>impacts of %1 lose energy, so bodies can come to rest</source>
        <translation>Stöße von %1 verlieren Energie, also können Körper zur Ruhe kommen</translation>
    </message>
    <message>
        <source>%1 slows down what it touches, so bodies can come to rest</source>
        <translation>%1 bremst, was berührt wird, also können Körper zur Ruhe kommen</translation>
    </message>
    <message>
        <source>%1 slows down what rolls on it, so bodies can come to rest</source>
        <translation>%1 bremst, was darauf rollt, also können Körper zur Ruhe kommen</translation>
    </message>
    <message>
        <source>a spring is damped, so bodies can come to rest</source>
        <translation>eine Feder ist gedämpft, also können Körper zur Ruhe kommen</translation>
    </message>
    <message>
        <source>no two bodies can meet, so nothing can come to rest on anything</source>
        <translation>keine zwei Körper können sich treffen, also kann nichts auf etwas zur Ruhe kommen</translation>
    </message>
    <message>
        <source>every impact is elastic and nothing rubs: nothing can come to rest</source>
        <translation>jeder Stoß ist elastisch, und nichts reibt: nichts kann zur Ruhe kommen</translation>
    </message>
    <message>
        <source>they are simulated at full cost</source>
        <translation>sie werden mit vollem Aufwand simuliert</translation>
    </message>
    <message>
        <source>in every pair that can meet, one body has `elastic 0`</source>
        <translation>in jedem Paar, das sich treffen kann, hat ein Körper `elastic 0`</translation>
    </message>
    <message>
        <source>%1 and %2 part with %3 times the speed they meet at</source>
        <translation>%1 und %2 trennen sich mit dem %3-fachen der Geschwindigkeit, mit der sie sich treffen</translation>
    </message>
    <message>
        <source>the lever arm is 0 for every pair that can meet</source>
        <translation>der Hebelarm ist 0 für jedes Paar, das sich treffen kann</translation>
    </message>
    <message>
        <source>%1 has rolling resistance</source>
        <translation>%1 hat Rollwiderstand</translation>
    </message>
    <message>
        <source>it rolls without it</source>
        <translation>gerollt wird ohne ihn</translation>
    </message>
    <message>
        <source>%1 spins from the start</source>
        <translation>%1 dreht sich von Anfang an</translation>
    </message>
    <message>
        <source>%1 is not a sphere and can be hit beside its centre</source>
        <translation>%1 ist keine Kugel und kann neben der Mitte getroffen werden</translation>
    </message>
    <message>
        <source>friction can set %1 turning</source>
        <translation>Reibung kann %1 in Drehung versetzen</translation>
    </message>
    <message>
        <source>what rolls over %1 is held back</source>
        <translation>was über %1 rollt, wird gebremst</translation>
    </message>
    <message>
        <source>a spring between %1 and %2 pulls beside a centre</source>
        <translation>eine Feder zwischen %1 und %2 zieht neben einer Mitte</translation>
    </message>
    <message>
        <source>no body spins at the start, and impulses without friction pass through a sphere&apos;s centre</source>
        <translation>kein Körper dreht sich am Anfang, und Kraftstöße ohne Reibung gehen durch die Mitte einer Kugel</translation>
    </message>
    <message>
        <source>the only body does not spin and can touch nothing</source>
        <translation>der einzige Körper dreht sich nicht und kann nichts berühren</translation>
    </message>
    <message>
        <source>a spring joins %1 and %2</source>
        <translation>eine Feder verbindet %1 und %2</translation>
    </message>
    <message>
        <source>it exerts no force</source>
        <translation>sie übt keine Kraft aus</translation>
    </message>
    <message>
        <source>no spring has an end that can move</source>
        <translation>keine Feder hat ein Ende, das sich bewegen kann</translation>
    </message>
    <message>
        <source>impacts at one moment are to act as one</source>
        <translation>Stöße im selben Augenblick sollen als einer wirken</translation>
    </message>
    <message>
        <source>method `%1`</source>
        <translation>Verfahren `%1`</translation>
    </message>
    <message>
        <source>a %1 is neither a sphere nor a wall</source>
        <translation>%1 ist weder Kugel noch Wand</translation>
    </message>
    <message>
        <source>Air drag</source>
        <translation>Luftwiderstand</translation>
    </message>
    <message>
        <source>air slows bodies between events</source>
        <translation>Luft bremst Körper zwischen Ereignissen</translation>
    </message>
    <message>
        <source>Broad-phase</source>
        <translation>Grobphase</translation>
    </message>
    <message>
        <source>Collision</source>
        <translation>Zusammenstoß</translation>
    </message>
    <message>
        <source>Continuous collision</source>
        <translation>Kontinuierliche Kollision</translation>
    </message>
    <message>
        <source>Friction</source>
        <translation>Reibung</translation>
    </message>
    <message>
        <source>friction would turn and slow the bodies it reaches</source>
        <translation>Reibung würde die Körper, die sie erreicht, drehen und bremsen</translation>
    </message>
    <message>
        <source>Gravity</source>
        <translation>Schwerkraft</translation>
    </message>
    <message>
        <source>Gyroscopic term</source>
        <translation>Kreiselterm</translation>
    </message>
    <message>
        <source>Resting</source>
        <translation>Ruhe</translation>
    </message>
    <message>
        <source>Restitution</source>
        <translation>Restitution</translation>
    </message>
    <message>
        <source>Rolling resistance</source>
        <translation>Rollwiderstand</translation>
    </message>
    <message>
        <source>rolling resistance acts between events</source>
        <translation>Rollwiderstand wirkt zwischen Ereignissen</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotation</translation>
    </message>
    <message>
        <source>Springs</source>
        <translation>Federn</translation>
    </message>
    <message>
        <source>springs bend the path of a body between events</source>
        <translation>Federn biegen die Bahn eines Körpers zwischen Ereignissen</translation>
    </message>
    <message>
        <source>what moves are smooth spheres</source>
        <translation>was sich bewegt, sind glatte Kugeln</translation>
    </message>
    <message>
        <source>the state was lost after %1 s</source>
        <translation>der Zustand ging nach %1 s verloren</translation>
    </message>
    <message>
        <source>it took longer than the %1 s that were left for it</source>
        <translation>es dauerte länger als die %1 s, die dafür blieben</translation>
    </message>
    <message>
        <source>energy changed by %1 %</source>
        <translation>die Energie änderte sich um %1 %</translation>
    </message>
    <message>
        <source>energy grew by %1 %</source>
        <translation>die Energie wuchs um %1 %</translation>
    </message>
    <message>
        <source>, 1 substep</source>
        <translation>, 1 Teilschritt</translation>
    </message>
    <message>
        <source>, %1 substeps</source>
        <translation>, %1 Teilschritte</translation>
    </message>
    <message>
        <source> (substep 1/%1 s)</source>
        <translation> (Teilschritt 1/%1 s)</translation>
    </message>
    <message>
        <source>, which is what the scene runs with.</source>
        <translation>; damit läuft die Szene schon.</translation>
    </message>
    <message>
        <source>. The scene&apos;s own setting, </source>
        <translation>. Die eigene Einstellung der Szene, </translation>
    </message>
    <message>
        <source>, errs by %1 at %2 ms</source>
        <translation>, hat einen Fehler von %1 bei %2 ms</translation>
    </message>
    <message>
        <source> is %1 times cheaper and no worse by any measure</source>
        <translation> ist %1-mal so billig und nach keinem Maß schlechter</translation>
    </message>
    <message>
        <source>By this measure alone, </source>
        <translation>Nach diesem Maß allein reichte </translation>
    </message>
    <message>
        <source> would do at %1 ms; by `%2` it errs by %3.</source>
        <translation> bei %1 ms; nach `%2` ist der Fehler %3.</translation>
    </message>
    <message>
        <source>Nothing moves: every setting holds; the cheapest costs %1 ms per simulated second: </source>
        <translation>Nichts bewegt sich: jede Einstellung hält; die billigste kostet %1 ms je simulierter Sekunde: </translation>
    </message>
    <message>
        <source>Nothing moves: %1 of %2 settings hold; the cheapest of them costs %3 ms per simulated second: </source>
        <translation>Nichts bewegt sich: %1 von %2 Einstellungen halten; die billigste davon kostet %3 ms je simulierter Sekunde: </translation>
    </message>
    <message>
        <source>, holds, too, at %1 ms</source>
        <translation>, hält ebenfalls, bei %1 ms</translation>
    </message>
    <message>
        <source>, does not hold, at %1 ms</source>
        <translation>, hält nicht, bei %1 ms</translation>
    </message>
    <message>
        <source>Nothing can be recommended: no setting ran with its invariants whole.</source>
        <translation>Nichts kann empfohlen werden: keine Einstellung hat alle Erhaltungsgrößen bewahrt.</translation>
    </message>
    <message>
        <source> below %1 costs %2 ms per simulated second: </source>
        <translation> unter %1 kostet %2 ms je simulierter Sekunde: </translation>
    </message>
    <message>
        <source> below %1, what chance makes of it here, costs %2 ms per simulated second: </source>
        <translation> unter %1, was hier schon der Zufall ausmacht, kostet %2 ms je simulierter Sekunde: </translation>
    </message>
    <message>
        <source> below %1 was reached by no setting; the least, %2, costs %3 ms per simulated second: </source>
        <translation> unter %1 wurde von keiner Einstellung erreicht; der kleinste Wert, %2, kostet %3 ms je simulierter Sekunde: </translation>
    </message>
    <message>
        <source>, each body as long as it can be followed: up to %1 s</source>
        <translation>, jeder Körper, solange er verfolgt werden kann: bis %1 s</translation>
    </message>
    <message>
        <source>, each body as long as it can be followed: the first up to %1 s, half of them up to %2 s, %3 of %4 to the end</source>
        <translation>, jeder Körper, solange er verfolgt werden kann: der erste bis %1 s, die Hälfte bis %2 s, %3 von %4 bis zum Ende</translation>
    </message>
    <message>
        <source> (copies %1 apart part at %2 /s)</source>
        <translation> (Kopien im Abstand %1 entfernen sich mit %2 /s)</translation>
    </message>
    <message>
        <source>Errors are against the closed form</source>
        <translation>Fehler sind Abweichungen von der geschlossenen Lösung</translation>
    </message>
    <message>
        <source>Errors are against the exact events</source>
        <translation>Fehler sind Abweichungen von den exakten Ereignissen</translation>
    </message>
    <message>
        <source>Errors are against the converged run</source>
        <translation>Fehler sind Abweichungen vom konvergierten Lauf</translation>
    </message>
    <message>
        <source>There is no reference solution: </source>
        <translation>Es gibt keine Referenzlösung: </translation>
    </message>
    <message>
        <source>The study was stopped before it had anything to compare with.</source>
        <translation>Die Studie wurde angehalten, bevor es etwas zum Vergleichen gab.</translation>
    </message>
    <message>
        <source>, good to %1</source>
        <translation>, genau bis %1</translation>
    </message>
    <message>
        <source>Engine %1: </source>
        <translation>Engine %1: </translation>
    </message>
    <message>
        <source>the least error is %1 at %2 ms, steps a frame: %3</source>
        <translation>der kleinste Fehler ist %1 bei %2 ms, Schritte je Bild: %3</translation>
    </message>
    <message>
        <source>; no worse is </source>
        <translation>; nicht schlechter ist </translation>
    </message>
    <message>
        <source> at %1 ms</source>
        <translation> bei %1 ms</translation>
    </message>
    <message>
        <source>Only the first %1 s of %2 s were studied: more does not fit into the budget of %3 s.</source>
        <translation>Nur die ersten %1 s von %2 s wurden untersucht: mehr passt nicht in die %3 s, die dafür da sind.</translation>
    </message>
    <message>
        <source>1 setting was left out, which does not fit into it: </source>
        <translation>1 Einstellung wurde ausgelassen, weil die Zeit nicht reicht: </translation>
    </message>
    <message>
        <source>%1 settings were left out, which do not fit into it: </source>
        <translation>%1 Einstellungen wurden ausgelassen, weil die Zeit nicht reicht: </translation>
    </message>
    <message>
        <source>half of the bodies can be followed for %1 s of %2 s only, then their ways are chance</source>
        <translation>die Hälfte der Körper kann nur %1 s von %2 s lang verfolgt werden, danach sind ihre Wege Zufall</translation>
    </message>
    <message>
        <source>impacts cannot be told from smooth motion in it</source>
        <translation>Stöße sind darin nicht von glatter Bewegung zu unterscheiden</translation>
    </message>
    <message>
        <source>nothing hits anything while it can be followed</source>
        <translation>nichts stößt an etwas, solange es verfolgt werden kann</translation>
    </message>
    <message>
        <source>nothing takes energy out of the scene, so nothing comes to rest</source>
        <translation>nichts nimmt der Szene Energie, also kommt nichts zur Ruhe</translation>
    </message>
    <message>
        <source>there is no run to its end to compare with</source>
        <translation>es gibt keinen Lauf bis zum Ende zum Vergleichen</translation>
    </message>
    <message>
        <source>no setting has been measured by it</source>
        <translation>keine Einstellung wurde damit gemessen</translation>
    </message>
    <message>
        <source>no setting differs from none by more than can be told, %1</source>
        <translation>keine Einstellung weicht um mehr ab, als man unterscheiden kann, %1</translation>
    </message>
    <message>
        <source>it is %1 for every setting</source>
        <translation>es ist %1 für jede Einstellung</translation>
    </message>
    <message>
        <source>Measured by `%1`, as asked for.</source>
        <translation>Gemessen mit `%1`, wie verlangt.</translation>
    </message>
    <message>
        <source>Measured by `%1`, the first that says something.</source>
        <translation>Gemessen mit `%1`, dem ersten Maß, das etwas aussagt.</translation>
    </message>
    <message>
        <source>Measured by `%1`</source>
        <translation>Gemessen mit `%1`</translation>
    </message>
    <message>
        <source>`%1` says nothing here: </source>
        <translation>`%1` sagt hier nichts: </translation>
    </message>
    <message>
        <source>no run of the most accurate setting came to an end with its state whole</source>
        <translation>kein Lauf der genauesten Einstellung kam mit heilem Zustand zum Ende</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>error: distance by scene size, or angle in rad</source>
        <translation>Fehler: Abstand durch Szenengröße oder Winkel in rad</translation>
    </message>
    <message>
        <source>The largest distance from the reference solution, relative to the scene&apos;s size, or the largest angle in rad; of each body as long as it can be followed.</source>
        <translation>Der größte Abstand von der Referenzlösung, relativ zur Größe der Szene, oder der größte Winkel in rad; jeder Körper, solange er verfolgt werden kann.</translation>
    </message>
    <message>
        <source>Error of impacts</source>
        <translation>Fehler der Stöße</translation>
    </message>
    <message>
        <source>impacts: missed, or time off by duration</source>
        <translation>Stöße: verfehlt, oder Zeitfehler durch Dauer</translation>
    </message>
    <message>
        <source>The part of the impacts that is missed, or how much too early or late the others come, relative to the duration.</source>
        <translation>Der Teil der Stöße, der fehlt, oder wie viel zu früh oder zu spät die anderen kommen, relativ zur Dauer.</translation>
    </message>
    <message>
        <source>Error of energy</source>
        <translation>Fehler der Energie</translation>
    </message>
    <message>
        <source>error of energy, relative to what is exchanged</source>
        <translation>Fehler der Energie, relativ zur umgesetzten</translation>
    </message>
    <message>
        <source>How far the energy is off, up or down: from its start in a scene that loses none, else from its course in the reference solution as far as that is certain; relative to the largest exchanged in the run, at least to a thousandth of weight times size.</source>
        <translation>Wie weit die Energie abweicht, nach oben oder unten: vom Anfang, wo keine verloren geht, sonst von ihrem Verlauf in der Referenzlösung, soweit der sicher ist; relativ zur größten umgesetzten im Lauf, mindestens zu einem Tausendstel von Gewicht mal Größe.</translation>
    </message>
    <message>
        <source>Largest overlap</source>
        <translation>Größte Überlappung</translation>
    </message>
    <message>
        <source>largest overlap by half thickness</source>
        <translation>größte Überlappung durch halbe Dicke</translation>
    </message>
    <message>
        <source>The deepest overlap of two bodies, relative to half the thickness of the thinnest.</source>
        <translation>Die tiefste Überlappung zweier Körper, relativ zur halben Dicke des dünnsten.</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>residual of contacts, relative</source>
        <translation>Residuum der Kontakte, relativ</translation>
    </message>
    <message>
        <source>How far the worst contact problem was from solved, relative to the speed that the largest energy exchanged would give all bodies.</source>
        <translation>Wie weit das schlechteste Kontaktproblem von seiner Lösung entfernt war, relativ zur Geschwindigkeit, die die größte umgesetzte Energie allen Körpern gäbe.</translation>
    </message>
    <message>
        <source>Error at the end</source>
        <translation>Fehler am Ende</translation>
    </message>
    <message>
        <source>what is left at the end: deviation</source>
        <translation>was am Ende übrig ist: Abweichung</translation>
    </message>
    <message>
        <source>What is left at the end: height and centre of mass relative to the scene&apos;s size, time to rest relative to the duration, energy lost relative to the largest exchanged.</source>
        <translation>Was am Ende übrig ist: Höhe und Schwerpunkt relativ zur Größe der Szene, Zeit bis zur Ruhe relativ zur Dauer, verlorene Energie relativ zur größten umgesetzten.</translation>
    </message>
    <message>
        <source>drag coefficient</source>
        <translation>Widerstandsbeiwert</translation>
    </message>
    <message>
        <source>friction</source>
        <translation>Reibung</translation>
    </message>
    <message>
        <source>elasticity</source>
        <translation>Elastizität</translation>
    </message>
    <message>
        <source>rolling resistance</source>
        <translation>Rollwiderstand</translation>
    </message>
    <message>
        <source>free motion</source>
        <translation>freie Bewegung</translation>
    </message>
    <message>
        <source>harmonic oscillation</source>
        <translation>harmonische Schwingung</translation>
    </message>
    <message>
        <source>Errors are deviations from the scene&apos;s own finest run (</source>
        <translation>Fehler sind Abweichungen vom feinsten Lauf der Szene selbst (</translation>
    </message>
    <message>
        <source>, good to %1): those below %2 say little else</source>
        <translation>, genau bis %1): unter %2 sagen sie sonst wenig</translation>
    </message>
    <message>
        <source>air slows %1, so bodies can come to rest</source>
        <translation>Luft bremst %1, also können Körper zur Ruhe kommen</translation>
    </message>
</context>
<context>
    <name>carom::DiagnosticMarks</name>
    <message>
        <source>line %1: %2</source>
        <translation>Zeile %1: %2</translation>
    </message>
    <message>
        <source>Ctrl+. — %1</source>
        <translation>Strg+. – %1</translation>
    </message>
</context>
<context>
    <name>carom::DifferenceView</name>
    <message>
        <source>The file holds this text already.</source>
        <translation>Die Datei enthält diesen Text schon.</translation>
    </message>
</context>
<context>
    <name>carom::Document</name>
    <message>
        <source>“%1” is a folder; choose a scene file in it</source>
        <translation>„%1“ ist ein Ordner; wählen Sie eine Szenendatei darin</translation>
    </message>
    <message>
        <source>“%1” cannot be read: %2</source>
        <translation>„%1“ kann nicht gelesen werden: %2</translation>
    </message>
    <message>
        <source>the text has no file yet; choose a name for it</source>
        <translation>der Text hat noch keine Datei; wählen Sie einen Namen</translation>
    </message>
    <message>
        <source>“%1” is a device or a pipe; choose a scene file</source>
        <translation>„%1“ ist ein Gerät oder eine Pipe; wählen Sie eine Szenendatei</translation>
    </message>
    <message>
        <source>“%1” has %2 MiB; a scene&apos;s text may have %3 MiB</source>
        <translation>„%1“ hat %2 MiB; der Text einer Szene darf %3 MiB haben</translation>
    </message>
</context>
<context>
    <name>carom::DrawingThread</name>
    <message>
        <source>this display offers no OpenGL</source>
        <translation>diese Anzeige bietet kein OpenGL</translation>
    </message>
</context>
<context>
    <name>carom::EditCommands</name>
    <message>
        <source>Go to line</source>
        <translation>Gehe zu Zeile</translation>
    </message>
    <message>
        <source>Line, 1 to %1:</source>
        <translation>Zeile, 1 bis %1:</translation>
    </message>
    <message>
        <source>There is no quick fix for what is at the caret</source>
        <translation>Für das, was am Cursor steht, gibt es keine Schnellkorrektur</translation>
    </message>
</context>
<context>
    <name>carom::EffectsDock</name>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>The scene is empty.
Once there are bodies in it, this says which effects they call for, and why.</source>
        <translation>Die Szene ist leer.
Sind Körper darin, steht hier, welche Effekte sie verlangen, und warum.</translation>
    </message>
    <message>
        <source>line %1</source>
        <translation>Zeile %1</translation>
    </message>
    <message>
        <source>A frame takes %1 ms</source>
        <translation>Ein Bild braucht %1 ms</translation>
    </message>
    <message>
        <source>%1; what is absent takes nothing</source>
        <translation>%1; was fehlt, braucht nichts</translation>
    </message>
</context>
<context>
    <name>carom::ExpectMenu</name>
    <message>
        <source>Nothing has been measured yet</source>
        <translation>Es ist noch nichts gemessen</translation>
    </message>
    <message>
        <source>Write into the text:</source>
        <translation>In den Text schreiben:</translation>
    </message>
</context>
<context>
    <name>carom::ExpectationCommands</name>
    <message>
        <source>First failed here: %1</source>
        <translation>Hier zuerst verfehlt: %1</translation>
    </message>
    <message>
        <source>not written: what is on screen is not the text as it is now</source>
        <translation>nicht geschrieben: was zu sehen ist, ist nicht der Text, wie er jetzt ist</translation>
    </message>
    <message>
        <source>written into the text: %1</source>
        <translation>in den Text geschrieben: %1</translation>
    </message>
</context>
<context>
    <name>carom::ExportMenu</name>
    <message>
        <source>Export</source>
        <translation>Ausgeben</translation>
    </message>
    <message>
        <source>Write the chart or its figures to a file</source>
        <translation>Das Diagramm oder seine Zahlen in eine Datei schreiben</translation>
    </message>
    <message>
        <source>%1…</source>
        <translation>%1 …</translation>
    </message>
</context>
<context>
    <name>carom::FileCommands</name>
    <message>
        <source>opened %1</source>
        <translation>%1 geöffnet</translation>
    </message>
    <message>
        <source>Unsaved changes</source>
        <translation>Nicht gespeicherte Änderungen</translation>
    </message>
    <message>
        <source>“%1” has changes that are not saved.</source>
        <translation>„%1“ hat Änderungen, die nicht gespeichert sind.</translation>
    </message>
    <message>
        <source>new scene</source>
        <translation>neue Szene</translation>
    </message>
    <message>
        <source>new scene: %1</source>
        <translation>neue Szene: %1</translation>
    </message>
    <message>
        <source>Open a scene</source>
        <translation>Szene öffnen</translation>
    </message>
    <message>
        <source>saved %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source>Save the scene as</source>
        <translation>Szene speichern unter</translation>
    </message>
    <message>
        <source>reloaded %1</source>
        <translation>%1 neu geladen</translation>
    </message>
    <message>
        <source>Save the window as a picture</source>
        <translation>Fenster als Bild speichern</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>%1[*] – Carom</source>
        <translation>%1[*] – Carom</translation>
    </message>
    <message>
        <source>%1[*] (%2) – Carom</source>
        <translation>%1[*] (%2) – Carom</translation>
    </message>
    <message>
        <source>Carom</source>
        <translation>Carom</translation>
    </message>
    <message>
        <source>opened %1 as a new scene</source>
        <translation>%1 als neue Szene geöffnet</translation>
    </message>
    <message>
        <source>reloaded %1; Undo brings back the text before</source>
        <translation>%1 neu geladen; Rückgängig bringt den Text davor zurück</translation>
    </message>
    <message>
        <source>reloaded %1, which was changed outside; Undo brings back the text before</source>
        <translation>%1 neu geladen, von einem anderen Programm geändert; Rückgängig bringt den Text davor zurück</translation>
    </message>
    <message>
        <source>%1 was deleted or moved outside; its text is kept here, unsaved</source>
        <translation>%1 wurde von einem anderen Programm gelöscht oder verschoben; der Text ist hier noch da, ungespeichert</translation>
    </message>
</context>
<context>
    <name>carom::FindBar</name>
    <message>
        <source>Find</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Replace with</source>
        <translation>Ersetzen durch</translation>
    </message>
    <message>
        <source>Regular e&amp;xpression</source>
        <translation>Regulärer Aus&amp;druck</translation>
    </message>
    <message>
        <source>Match &amp;case</source>
        <translation>&amp;Groß/klein</translation>
    </message>
    <message>
        <source>&amp;Previous</source>
        <translation>&amp;Zurück</translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>&amp;Replace</source>
        <translation>&amp;Ersetzen</translation>
    </message>
    <message>
        <source>Replace &amp;all</source>
        <translation>&amp;Alle ersetzen</translation>
    </message>
    <message>
        <source>not found</source>
        <translation>nicht gefunden</translation>
    </message>
    <message numerus="yes">
        <source>%n replaced</source>
        <translation>
            <numerusform>%n ersetzt</numerusform>
            <numerusform>%n ersetzt</numerusform>
        </translation>
    </message>
    <message>
        <source>no regular expression: %1</source>
        <translation>kein regulärer Ausdruck: %1</translation>
    </message>
    <message>
        <source>; went on from the top</source>
        <translation>; oben fortgesetzt</translation>
    </message>
    <message>
        <source>; went on from the end</source>
        <translation>; am Ende fortgesetzt</translation>
    </message>
    <message>
        <source>counting…</source>
        <translation>zählt…</translation>
    </message>
    <message>
        <source>more than %1</source>
        <translation>mehr als %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>%1 found</source>
        <translation>%1 gefunden</translation>
    </message>
</context>
<context>
    <name>carom::HelpCommands</name>
    <message>
        <source>About Carom</source>
        <translation>Über Carom</translation>
    </message>
    <message>
        <source>&lt;h3&gt;Carom %1&lt;/h3&gt;&lt;p&gt;Scenes of rigid bodies: written, watched, measured.&lt;/p&gt;&lt;p&gt;Free software under the GNU General Public License, version 3 or later.&lt;/p&gt;</source>
        <translation>&lt;h3&gt;Carom %1&lt;/h3&gt;&lt;p&gt;Szenen starrer Körper: schreiben, ansehen, messen.&lt;/p&gt;&lt;p&gt;Freie Software unter der GNU General Public License, Version 3 oder später.&lt;/p&gt;</translation>
    </message>
</context>
<context>
    <name>carom::InspectorDock</name>
    <message>
        <source>Inspector</source>
        <translation>Inspektor</translation>
    </message>
    <message>
        <source>The scene is empty.
Click a body, or put the caret into its declaration, to see its values here.</source>
        <translation>Die Szene ist leer.
Ein Klick auf einen Körper, oder die Schreibmarke in seiner Deklaration, zeigt hier seine Werte.</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Values of the selected body</source>
        <translation>Werte des gewählten Körpers</translation>
    </message>
    <message>
        <source>The whole scene now</source>
        <translation>Die ganze Szene jetzt</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>radius</source>
        <translation>Radius</translation>
    </message>
    <message>
        <source>height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>normal</source>
        <translation>Normale</translation>
    </message>
    <message>
        <source>distance from the origin</source>
        <translation>Abstand vom Ursprung</translation>
    </message>
    <message>
        <source>mass</source>
        <translation>Masse</translation>
    </message>
    <message>
        <source>immobile</source>
        <translation>unbeweglich</translation>
    </message>
    <message>
        <source>moment of inertia</source>
        <translation>Trägheitsmoment</translation>
    </message>
    <message>
        <source>inertia about %1</source>
        <translation>Trägheit um %1</translation>
    </message>
    <message>
        <source>position at start</source>
        <translation>Ort am Anfang</translation>
    </message>
    <message>
        <source>velocity at start</source>
        <translation>Geschwindigkeit am Anfang</translation>
    </message>
    <message>
        <source>colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Sweep this value…</source>
        <translation>Diesen Wert variieren …</translation>
    </message>
    <message>
        <source>Sweep its %1…</source>
        <translation>%1 davon variieren …</translation>
    </message>
    <message>
        <source>A click on the square chooses another one</source>
        <translation>Ein Klick auf das Quadrat wählt eine andere</translation>
    </message>
</context>
<context>
    <name>carom::LanguageCommands</name>
    <message>
        <source>The caret is in no declaration&apos;s braces</source>
        <translation>Die Schreibmarke steht in keiner Deklaration</translation>
    </message>
    <message>
        <source>There is no label at the caret; labels stand behind a body&apos;s type</source>
        <translation>An der Schreibmarke steht kein Name; Namen stehen hinter der Art des Körpers</translation>
    </message>
    <message>
        <source>There is no number at the caret</source>
        <translation>An der Schreibmarke steht keine Zahl</translation>
    </message>
    <message>
        <source>There is no label at the caret</source>
        <translation>An der Schreibmarke steht kein Name</translation>
    </message>
    <message>
        <source>No body carries this label</source>
        <translation>Kein Körper trägt diesen Namen</translation>
    </message>
    <message>
        <source>Laid out; Ctrl+Z takes it back</source>
        <translation>Angeordnet; Strg+Z nimmt es zurück</translation>
    </message>
    <message>
        <source>The text is formatted already</source>
        <translation>Der Text ist schon formatiert</translation>
    </message>
    <message>
        <source>There is no colour at the caret</source>
        <translation>An der Schreibmarke steht keine Farbe</translation>
    </message>
</context>
<context>
    <name>carom::LiteralHandles</name>
    <message>
        <source>Choose another colour</source>
        <translation>Eine andere Farbe wählen</translation>
    </message>
</context>
<context>
    <name>carom::LivePreview</name>
    <message>
        <source>1 error: the last scene without errors is shown</source>
        <translation>1 Fehler: die letzte fehlerfreie Szene wird gezeigt</translation>
    </message>
    <message>
        <source>%1 errors: the last scene without errors is shown</source>
        <translation>%1 Fehler: die letzte fehlerfreie Szene wird gezeigt</translation>
    </message>
    <message>
        <source>1 error: the declaration it is in is left out</source>
        <translation>1 Fehler: seine Deklaration ist ausgelassen</translation>
    </message>
    <message>
        <source>%1 errors: the declarations they are in are left out</source>
        <translation>%1 Fehler: ihre Deklarationen sind ausgelassen</translation>
    </message>
    <message>
        <source>Simulating the changed scene to %1 s…</source>
        <translation>Die geänderte Szene wird bis %1 s simuliert …</translation>
    </message>
    <message>
        <source>Building was cancelled: this is the scene before it</source>
        <translation>Der Aufbau wurde abgebrochen: das ist die Szene davor</translation>
    </message>
</context>
<context>
    <name>carom::MainWindow</name>
    <message>
        <source>Tools</source>
        <translation>Werkzeuge</translation>
    </message>
    <message>
        <source>Show or hide this panel</source>
        <translation>Dieses Feld zeigen oder verbergen</translation>
    </message>
    <message>
        <source>line %1, column %2</source>
        <translation>Zeile %1, Spalte %2</translation>
    </message>
    <message>
        <source>&amp;Panels</source>
        <translation>&amp;Felder</translation>
    </message>
    <message>
        <source>Building</source>
        <translation>Aufbau</translation>
    </message>
</context>
<context>
    <name>carom::ManualWindow</name>
    <message>
        <source>command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>keys</source>
        <translation>Tasten</translation>
    </message>
    <message>
        <source>Manual – Carom</source>
        <translation>Handbuch – Carom</translation>
    </message>
    <message>
        <source>Ten minutes to a measured answer</source>
        <translation>In zehn Minuten zur gemessenen Antwort</translation>
    </message>
    <message>
        <source>State what must happen</source>
        <translation>Sagen, was geschehen muss</translation>
    </message>
    <message>
        <source>From a laptop to a cluster</source>
        <translation>Vom Laptop zum Cluster</translation>
    </message>
    <message>
        <source>The scene language</source>
        <translation>Die Szenensprache</translation>
    </message>
    <message>
        <source>Reading a work–precision diagram</source>
        <translation>Ein Aufwand-Genauigkeits-Diagramm lesen</translation>
    </message>
    <message>
        <source>Contents of the manual</source>
        <translation>Inhalt des Handbuchs</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Search the manual</source>
        <translation>Im Handbuch suchen</translation>
    </message>
    <message>
        <source>Shortcuts</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>Every key can be changed in the preferences. Alt with 1 to 9 goes to a panel, Esc back to the text. In the picture: the left button turns, the right one moves, the wheel zooms, F frames the selection, Home everything, Space plays. At the start the left button moves bodies, and the handles of a selected one move and turn it, with Ctrl in round steps; a right click opens a menu.</source>
        <translation>Jede Taste lässt sich in den Einstellungen ändern. Alt mit 1 bis 9 geht zu einem Feld, Esc zurück zum Text. Im Bild: die linke Taste dreht, die rechte verschiebt, das Rad vergrößert, F zeigt die Auswahl, Pos1 alles, die Leertaste spielt ab. Am Anfang bewegt die linke Taste Körper, und die Griffe eines gewählten bewegen und drehen ihn, mit Strg in runden Schritten; ein Rechtsklick öffnet ein Menü.</translation>
    </message>
    <message>
        <source>Hard cases</source>
        <translation>Harte Fälle</translation>
    </message>
    <message>
        <source>Scenes that are hard to simulate and have a right answer, which their `expect` declarations ask for. The welcome page opens them; `carom test` judges them, and so does the Stability panel, beside those that are no scenes. The comment at the top of each says where its answer comes from.</source>
        <translation>Szenen, die schwer zu simulieren sind und eine richtige Antwort haben, die ihre Deklarationen `expect` verlangen. Die Willkommensseite öffnet sie; `carom test` beurteilt sie, ebenso das Feld „Stabilität“, neben denen, die keine Szenen sind. Der Kommentar am Anfang sagt, woher die Antwort kommt.</translation>
    </message>
    <message>
        <source>scene</source>
        <translation>Szene</translation>
    </message>
    <message>
        <source>what is right</source>
        <translation>was richtig ist</translation>
    </message>
</context>
<context>
    <name>carom::MemoryUse</name>
    <message>
        <source>%1 of %2 MiB</source>
        <translation>%1 von %2 MiB</translation>
    </message>
    <message>
        <source>Memory that this run takes, of the most it may (Preferences):
states to go back to: %1 MiB
times of frames: %2 MiB
curves: %3 MiB
timeline: %4 MiB
When it is used up, states are kept further apart: nothing is lost, but going back takes longer.</source>
        <translation>Speicher dieses Laufs, von dem, was er nehmen darf (Einstellungen):
Zustände zum Zurückgehen: %1 MiB
Zeiten der Bilder: %2 MiB
Kurven: %3 MiB
Zeitleiste: %4 MiB
Ist er verbraucht, liegen die Zustände weiter auseinander: nichts geht verloren, nur dauert das Zurückgehen länger.</translation>
    </message>
</context>
<context>
    <name>carom::NewSceneDialog</name>
    <message>
        <source>New scene from a template or generator</source>
        <translation>Neue Szene aus Vorlage oder Generator</translation>
    </message>
    <message>
        <source>Templates and generators</source>
        <translation>Vorlagen und Generatoren</translation>
    </message>
    <message>
        <source>&amp;Create</source>
        <translation>&amp;Erzeugen</translation>
    </message>
    <message>
        <source>Templates</source>
        <translation>Vorlagen</translation>
    </message>
    <message>
        <source>Generators</source>
        <translation>Generatoren</translation>
    </message>
    <message>
        <source>How many</source>
        <translation>Wie viele</translation>
    </message>
    <message>
        <source>The same seed gives the same scene on every machine</source>
        <translation>Der gleiche Startwert gibt auf jedem Rechner die gleiche Szene</translation>
    </message>
    <message>
        <source>Seed</source>
        <translation>Startwert</translation>
    </message>
    <message>
        <source>%1 of text: too large to preview</source>
        <translation>%1 Text: zu groß für eine Vorschau</translation>
    </message>
    <message>
        <source>%1 bodies, %2 of text</source>
        <translation>%1 Körper, %2 Text</translation>
    </message>
</context>
<context>
    <name>carom::NumberScrubber</name>
    <message>
        <source>Drag to the left or right: the number changes (Shift: ten times as much, Ctrl: a tenth)</source>
        <translation>Nach links oder rechts ziehen: die Zahl ändert sich (Umschalt: zehnmal so viel, Strg: ein Zehntel)</translation>
    </message>
</context>
<context>
    <name>carom::OutlineDock</name>
    <message>
        <source>Outline</source>
        <translation>Gliederung</translation>
    </message>
    <message>
        <source>Find a declaration</source>
        <translation>Deklaration suchen</translation>
    </message>
    <message>
        <source>Nothing is declared yet.
Ctrl+J inserts a declaration.</source>
        <translation>Noch ist nichts deklariert.
Strg+J fügt eine Deklaration ein.</translation>
    </message>
</context>
<context>
    <name>carom::OutlineModel</name>
    <message>
        <source>left out: there is a mistake in it</source>
        <translation>ausgelassen: es ist ein Fehler darin</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Zeile</translation>
    </message>
</context>
<context>
    <name>carom::OutputDock</name>
    <message>
        <source>Output</source>
        <translation>Ausgabe</translation>
    </message>
    <message>
        <source>What is opened, built, run and saved is noted here, with times.</source>
        <translation>Was geöffnet, gebaut, gerechnet und gespeichert wird, steht hier mit der Zeit.</translation>
    </message>
</context>
<context>
    <name>carom::OutsideDialog</name>
    <message>
        <source>Changed by another program</source>
        <translation>Von einem anderen Programm geändert</translation>
    </message>
    <message>
        <source>Another program has changed “%1” since it was read. Saving replaces its text; the lines that differ are marked.</source>
        <translation>Ein anderes Programm hat „%1“ geändert, seit es gelesen wurde. Speichern ersetzt dessen Text; die unterschiedlichen Zeilen sind markiert.</translation>
    </message>
    <message>
        <source>Another program has changed “%1”, and so have you. The lines that differ are marked; what you take can be undone.</source>
        <translation>Ein anderes Programm hat „%1“ geändert, und Sie auch. Die unterschiedlichen Zeilen sind markiert; was Sie übernehmen, lässt sich rückgängig machen.</translation>
    </message>
    <message>
        <source>What this text changes in the file</source>
        <translation>Was dieser Text in der Datei ändert</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
    <message>
        <source>&amp;Keep this text</source>
        <translation>Diesen Text &amp;behalten</translation>
    </message>
    <message>
        <source>&amp;Take the file&apos;s text</source>
        <translation>Text der &amp;Datei übernehmen</translation>
    </message>
    <message>
        <source>&amp;Save this text</source>
        <translation>Diesen Text &amp;speichern</translation>
    </message>
</context>
<context>
    <name>carom::OverlayLegend</name>
    <message>
        <source>Length of the arrows</source>
        <translation>Länge der Pfeile</translation>
    </message>
    <message>
        <source>velocity: the way of %1 s</source>
        <translation>Geschwindigkeit: der Weg von %1 s</translation>
    </message>
    <message>
        <source>contact and its normal</source>
        <translation>Kontakt und seine Normale</translation>
    </message>
    <message>
        <source>contact force, at most %1 N</source>
        <translation>Kontaktkraft, höchstens %1 N</translation>
    </message>
    <message>
        <source>contact force</source>
        <translation>Kontaktkraft</translation>
    </message>
</context>
<context>
    <name>carom::OverlayTip</name>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>force %1 N, impulse %2 N s a frame</source>
        <translation>Kraft %1 N, Kraftstoß %2 N s je Bild</translation>
    </message>
    <message>
        <source>no friction</source>
        <translation>keine Reibung</translation>
    </message>
    <message>
        <source>slides; friction %1 N of %2 N</source>
        <translation>gleitet; Reibung %1 N von %2 N</translation>
    </message>
    <message>
        <source>sticks; friction %1 N of %2 N</source>
        <translation>haftet; Reibung %1 N von %2 N</translation>
    </message>
    <message>
        <source>%1: %2 m/s</source>
        <translation>%1: %2 m/s</translation>
    </message>
</context>
<context>
    <name>carom::Panel</name>
    <message>
        <source>there is nothing to export here</source>
        <translation>Hier gibt es nichts zum Ausgeben</translation>
    </message>
</context>
<context>
    <name>carom::PictureCommands</name>
    <message>
        <source>Save the view</source>
        <translation>Die Ansicht speichern</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Breite</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>saved %1</source>
        <translation>%1 gespeichert</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source> pictures a second</source>
        <translation> Bilder je Sekunde</translation>
    </message>
    <message>
        <source> × real time</source>
        <translation> × Echtzeit</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>To</source>
        <translation>Bis</translation>
    </message>
    <message>
        <source>Rate</source>
        <translation>Rate</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>Recording…</source>
        <translation>Aufnahme läuft …</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Picture %1 of %2, %3 s left</source>
        <translation>Bild %1 von %2, noch %3 s</translation>
    </message>
    <message>
        <source>recorded %1</source>
        <translation>%1 aufgenommen</translation>
    </message>
    <message>
        <source>not recorded: %1</source>
        <translation>nicht aufgenommen: %1</translation>
    </message>
    <message>
        <source>the camera is in the scene now</source>
        <translation>die Kamera steht jetzt in der Szene</translation>
    </message>
    <message>
        <source>Putting the pictures together…</source>
        <translation>Bilder werden zusammengefügt …</translation>
    </message>
    <message>
        <source>Record a video</source>
        <translation>Video aufnehmen</translation>
    </message>
    <message>
        <source>Animated pictures (*.gif);;Videos (*.mp4);;One picture a frame (*.png)</source>
        <translation>Animierte Bilder (*.gif);;Videos (*.mp4);;Ein Bild je Schritt (*.png)</translation>
    </message>
</context>
<context>
    <name>carom::PlotsDock</name>
    <message>
        <source>Plots</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>Add</source>
        <translation>Hinzufügen</translation>
    </message>
    <message>
        <source>Draw this quantity over time</source>
        <translation>Diese Größe über der Zeit zeichnen</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Take the selected curve off the chart (Delete)</source>
        <translation>Die gewählte Kurve aus dem Diagramm nehmen (Entf)</translation>
    </message>
    <message>
        <source>Choose a body and a quantity at the left and press Add to see it over time.</source>
        <translation>Links einen Körper und eine Größe wählen und „Hinzufügen“ drücken, um sie über der Zeit zu sehen.</translation>
    </message>
    <message>
        <source>Body</source>
        <translation>Körper</translation>
    </message>
    <message>
        <source>Quantity</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>Curves</source>
        <translation>Kurven</translation>
    </message>
    <message>
        <source>the whole scene</source>
        <translation>die ganze Szene</translation>
    </message>
    <message>
        <source>whole</source>
        <translation>Ganzes</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>there are no curves yet; add one first</source>
        <translation>es gibt noch keine Kurven; zuerst eine hinzufügen</translation>
    </message>
    <message>
        <source>filling in: frame %1 of %2</source>
        <translation>wird ergänzt: Bild %1 von %2</translation>
    </message>
    <message>
        <source>least %1</source>
        <translation>kleinster Wert, %1</translation>
    </message>
    <message>
        <source>greatest %1</source>
        <translation>größter Wert, %1</translation>
    </message>
    <message>
        <source>Expect this</source>
        <translation>Dies erwarten</translation>
    </message>
    <message>
        <source>Write what the selected curve shows into the text, as an expectation</source>
        <translation>Schreibt, was die gewählte Kurve zeigt, als Erwartung in den Text</translation>
    </message>
</context>
<context>
    <name>carom::Preferences</name>
    <message>
        <source>Left turns, right or middle moves</source>
        <translation>Links dreht, rechts oder Mitte schiebt</translation>
    </message>
    <message>
        <source>Left turns, middle moves, right zooms</source>
        <translation>Links dreht, Mitte schiebt, rechts zoomt</translation>
    </message>
    <message>
        <source>Middle turns, with Shift moves, with Ctrl zooms</source>
        <translation>Mitte dreht, mit Umschalt schiebt, mit Strg zoomt</translation>
    </message>
    <message>
        <source>Middle moves, with Shift turns; right zooms</source>
        <translation>Mitte schiebt, mit Umschalt dreht; rechts zoomt</translation>
    </message>
    <message>
        <source>Preferences</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Simulation</source>
        <translation>Simulation</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source> pt</source>
        <translation> pt</translation>
    </message>
    <message>
        <source>Font of the text</source>
        <translation>Schrift des Textes</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>The language changes at the next start. The scene language and its messages stay English.</source>
        <translation>Die Sprache wechselt beim nächsten Start. Die Szenensprache und ihre Meldungen bleiben englisch.</translation>
    </message>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>The wheel zooms at the pointer and a click selects, whatever is chosen here.</source>
        <translation>Das Rad zoomt am Zeiger und ein Klick wählt aus, was immer hier gewählt ist.</translation>
    </message>
    <message>
        <source> MiB</source>
        <translation> MiB</translation>
    </message>
    <message>
        <source>as many as the machine has</source>
        <translation>so viele, wie der Rechner hat</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Threads</translation>
    </message>
    <message>
        <source>The motion does not depend on the number of threads.</source>
        <translation>Die Bewegung hängt nicht von der Zahl der Threads ab.</translation>
    </message>
    <message>
        <source>as the machine does best</source>
        <translation>wie es der Rechner am besten kann</translation>
    </message>
    <message>
        <source>in the window, by OpenGL (graphics cards)</source>
        <translation>im Fenster, von OpenGL (Grafikkarten)</translation>
    </message>
    <message>
        <source>beside it, by a thread (software OpenGL)</source>
        <translation>daneben, von einem Thread (OpenGL in Software)</translation>
    </message>
    <message>
        <source>Viewport</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Pictures are drawn</source>
        <translation>Bilder werden gezeichnet</translation>
    </message>
    <message>
        <source>This changes at the next start. What is drawn is the same.</source>
        <translation>Das gilt ab dem nächsten Start. Gezeichnet wird dasselbe.</translation>
    </message>
    <message>
        <source>A key that belongs to another command is taken from it; those of the panels, Alt and a digit, stay theirs.</source>
        <translation>Eine Taste, die einem anderen Befehl gehört, wird ihm genommen; die der Felder, Alt und eine Ziffer, bleiben ihnen.</translation>
    </message>
    <message>
        <source>Appearance</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>Shortcuts</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>Shortcut</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>Shortcut of “%1”</source>
        <translation>Tastenkürzel von „%1“</translation>
    </message>
    <message>
        <source>Default</source>
        <translation>Standard</translation>
    </message>
    <message>
        <source>Give the command its default shortcut</source>
        <translation>Dem Befehl sein Standardkürzel geben</translation>
    </message>
    <message>
        <source>Navigation</source>
        <translation>Navigation</translation>
    </message>
    <message>
        <source>Rewind memory</source>
        <translation>Speicher zum Zurückspulen</translation>
    </message>
</context>
<context>
    <name>carom::ProblemsDock</name>
    <message>
        <source>Problems</source>
        <translation>Probleme</translation>
    </message>
    <message>
        <source>No problems.
What is wrong in the text is listed here as you type; F8 goes from one to the next.</source>
        <translation>Keine Probleme.
Was im Text falsch ist, steht hier beim Schreiben; F8 geht von einem zum nächsten.</translation>
    </message>
    <message>
        <source>Problems (%1)</source>
        <translation>Probleme (%1)</translation>
    </message>
</context>
<context>
    <name>carom::ProblemsModel</name>
    <message>
        <source>Message</source>
        <translation>Meldung</translation>
    </message>
    <message>
        <source>Line</source>
        <translation>Zeile</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Spalte</translation>
    </message>
    <message>
        <source>Code</source>
        <translation>Kennung</translation>
    </message>
    <message>
        <source>frame %1</source>
        <translation>Bild %1</translation>
    </message>
</context>
<context>
    <name>carom::ProgressStrip</name>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>%1: %2 s left</source>
        <translation>%1: noch %2 s</translation>
    </message>
</context>
<context>
    <name>carom::Race</name>
    <message>
        <source>position</source>
        <translation>Ort</translation>
    </message>
    <message>
        <source>orientation</source>
        <translation>Lage</translation>
    </message>
    <message>
        <source>velocity</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>angular velocity</source>
        <translation>Winkelgeschwindigkeit</translation>
    </message>
</context>
<context>
    <name>carom::RaceDock</name>
    <message>
        <source>Race</source>
        <translation>Wettlauf</translation>
    </message>
    <message>
        <source>Same text</source>
        <translation>Derselbe Text</translation>
    </message>
    <message>
        <source>Which text the second run is of</source>
        <translation>Von welchem Text der zweite Lauf ist</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Abspielen</translation>
    </message>
    <message>
        <source>Play both runs in real time</source>
        <translation>Beide Läufe in Echtzeit abspielen</translation>
    </message>
    <message>
        <source>A race runs the scene twice, with two settings or two texts, and shows how the runs part.
Choose what differs and then Race; the simulation above goes on meanwhile.</source>
        <translation>Ein Wettlauf lässt die Szene zweimal laufen, mit zwei Einstellungen oder zwei Texten, und zeigt, wie sich die Läufe trennen.
Wählen Sie, was verschieden ist, und dann Wettlauf; die Simulation oben läuft inzwischen weiter.</translation>
    </message>
    <message>
        <source>Preset</source>
        <translation>Voreinstellung</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Substeps</source>
        <translation>Teilschritte</translation>
    </message>
    <message>
        <source>Substeps a frame</source>
        <translation>Teilschritte je Bild</translation>
    </message>
    <message>
        <source>Substeps of the text</source>
        <translation>Teilschritte des Textes</translation>
    </message>
    <message>
        <source> substeps</source>
        <translation> Teilschritte</translation>
    </message>
    <message>
        <source>Simulated time</source>
        <translation>Simulierte Zeit</translation>
    </message>
    <message>
        <source>How long both runs last</source>
        <translation>Wie lange beide Läufe dauern</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Show the first frame in which a bit differs</source>
        <translation>Das erste Bild zeigen, in dem sich ein Bit unterscheidet</translation>
    </message>
    <message>
        <source>The same text</source>
        <translation>Derselbe Text</translation>
    </message>
    <message>
        <source>The text as it is now</source>
        <translation>Der Text, wie er jetzt ist</translation>
    </message>
    <message>
        <source>%1 before</source>
        <translation>%1 vorher</translation>
    </message>
    <message>
        <source>A file…</source>
        <translation>Eine Datei…</translation>
    </message>
    <message>
        <source>over</source>
        <translation>über</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>The other text</source>
        <translation>Der andere Text</translation>
    </message>
    <message>
        <source>Scenes (*.sdl);;All files (*)</source>
        <translation>Szenen (*.sdl);;Alle Dateien (*)</translation>
    </message>
    <message>
        <source>%1 cannot be read: %2</source>
        <translation>%1 kann nicht gelesen werden: %2</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Keep what was computed so far</source>
        <translation>Behalten, was bisher berechnet ist</translation>
    </message>
    <message>
        <source>Run the scene both ways</source>
        <translation>Die Szene auf beide Arten laufen lassen</translation>
    </message>
    <message>
        <source>Nothing in the scene can move</source>
        <translation>Nichts in der Szene kann sich bewegen</translation>
    </message>
    <message>
        <source>computing</source>
        <translation>wird berechnet</translation>
    </message>
    <message>
        <source>%1 m apart after %2 frames</source>
        <translation>%1 m auseinander nach %2 Bildern</translation>
    </message>
    <message>
        <source>race of %1: %2; %3</source>
        <translation>Wettlauf von %1: %2; %3</translation>
    </message>
    <message>
        <source>no bit differs in %1 frames</source>
        <translation>in %1 Bildern unterscheidet sich kein Bit</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>greatest distance of a body from itself</source>
        <translation>größter Abstand eines Körpers von sich selbst</translation>
    </message>
    <message>
        <source>there was no race yet; choose Race first</source>
        <translation>es gab noch keinen Wettlauf; wählen Sie zuerst Wettlauf</translation>
    </message>
    <message>
        <source>Integrator</source>
        <translation>Integrationsverfahren</translation>
    </message>
    <message>
        <source>Stopped</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>Preset of the text</source>
        <translation>Voreinstellung des Textes</translation>
    </message>
    <message>
        <source>Method of the text</source>
        <translation>Verfahren des Textes</translation>
    </message>
    <message>
        <source>Integrator of the text</source>
        <translation>Integrator des Textes</translation>
    </message>
    <message>
        <source>preset %1</source>
        <translation>Voreinstellung %1</translation>
    </message>
    <message>
        <source>method %1</source>
        <translation>Verfahren %1</translation>
    </message>
    <message>
        <source>integrator %1</source>
        <translation>Integrator %1</translation>
    </message>
    <message>
        <source>%1 substeps a frame</source>
        <translation>%1 Teilschritte je Bild</translation>
    </message>
    <message>
        <source>first difference: frame %1, %2 s: %3 of %4</source>
        <translation>erster Unterschied: Bild %1, %2 s: %3 von %4</translation>
    </message>
</context>
<context>
    <name>carom::RecoveryDialog</name>
    <message>
        <source>Unsaved text found</source>
        <translation>Nicht gespeicherter Text gefunden</translation>
    </message>
    <message>
        <source>Carom ended unexpectedly. This text was typed and not saved; the lines that differ from the file are marked.</source>
        <translation>Carom wurde unerwartet beendet. Dieser Text wurde geschrieben und nicht gespeichert; Zeilen, die von der Datei abweichen, sind markiert.</translation>
    </message>
    <message>
        <source>Unsaved texts</source>
        <translation>Nicht gespeicherte Texte</translation>
    </message>
    <message>
        <source>What the unsaved text changes</source>
        <translation>Was der nicht gespeicherte Text ändert</translation>
    </message>
    <message>
        <source>a scene without a file</source>
        <translation>eine Szene ohne Datei</translation>
    </message>
    <message>
        <source>Ask me &amp;later</source>
        <translation>&amp;Später fragen</translation>
    </message>
    <message>
        <source>&amp;Recover</source>
        <translation>&amp;Wiederherstellen</translation>
    </message>
    <message>
        <source>&amp;Discard</source>
        <translation>&amp;Verwerfen</translation>
    </message>
</context>
<context>
    <name>carom::RenameBox</name>
    <message>
        <source>New name of the label</source>
        <translation>Neuer Name</translation>
    </message>
    <message>
        <source>Enter the new name; Esc gives up</source>
        <translation>Den neuen Namen eingeben; Esc gibt auf</translation>
    </message>
    <message>
        <source>Enter renames it</source>
        <translation>Eingabe ändert den Namen</translation>
    </message>
    <message>
        <source>Enter renames it in %1 places</source>
        <translation>Eingabe ändert den Namen an %1 Stellen</translation>
    </message>
</context>
<context>
    <name>carom::RunCommands</name>
    <message>
        <source>broad-phase: %1</source>
        <translation>Grobphase: %1</translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation>&amp;Anhalten</translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation>&amp;Abspielen</translation>
    </message>
    <message>
        <source>Stopped at frame %1: the %2 of %3 is not finite, or too large to follow</source>
        <translation>Angehalten bei Bild %1: „%2“ von %3 ist nicht endlich oder zu groß, um ihm zu folgen</translation>
    </message>
    <message>
        <source>No breakpoint held before this frame</source>
        <translation>Vor diesem Bild traf kein Haltepunkt zu</translation>
    </message>
    <message>
        <source>Frame %1, %2 s: %3</source>
        <translation>Bild %1, %2 s: %3</translation>
    </message>
    <message>
        <source>broad-phase: as the scene asks</source>
        <translation>Grobphase: wie die Szene verlangt</translation>
    </message>
    <message>
        <source>%1 bodies, %2</source>
        <translation>%1 Körper, %2</translation>
    </message>
    <message>
        <source>Stopped at frame %1: there is not enough memory for it</source>
        <translation>Angehalten bei Bild %1: dafür reicht der Speicher nicht</translation>
    </message>
    <message>
        <source>Stopped at frame %1 by an error inside the program</source>
        <translation>Angehalten bei Bild %1 durch einen Fehler im Programm</translation>
    </message>
    <message>
        <source>Frame %1: nothing met in it</source>
        <translation>Bild %1: nichts stieß darin zusammen</translation>
    </message>
    <message>
        <source>Frame %1: %2 changed its motion most, %3</source>
        <translation>Bild %1: am meisten änderte sich die Bewegung von %2, %3</translation>
    </message>
    <message>
        <source>Frame %1: %2 met %3, %4</source>
        <translation>Bild %1: %2 traf auf %3, %4</translation>
    </message>
    <message>
        <source>The run %1; shorter steps or more substeps may hold it</source>
        <translation>Der Lauf: %1; kürzere Schritte oder mehr Teilschritte können das verhindern</translation>
    </message>
    <message>
        <source>no energy lost</source>
        <translation>keine Energie verloren</translation>
    </message>
    <message>
        <source>%1 J lost</source>
        <translation>%1 J verloren</translation>
    </message>
    <message>
        <source>%1 J gained</source>
        <translation>%1 J gewonnen</translation>
    </message>
    <message>
        <source>impulse %1 N s, %2</source>
        <translation>Kraftstoß %1 N s, %2</translation>
    </message>
</context>
<context>
    <name>carom::RunComparison</name>
    <message>
        <source>Forget</source>
        <translation>Vergessen</translation>
    </message>
    <message>
        <source>Take the first run off the list</source>
        <translation>Den ersten Lauf von der Liste nehmen</translation>
    </message>
    <message>
        <source>the run on screen</source>
        <translation>der Lauf auf dem Bildschirm</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>First run</source>
        <translation>Erster Lauf</translation>
    </message>
    <message>
        <source>Second run</source>
        <translation>Zweiter Lauf</translation>
    </message>
    <message>
        <source>Part of the frame</source>
        <translation>Teil des Bildes</translation>
    </message>
    <message>
        <source>first [ms]</source>
        <translation>erster [ms]</translation>
    </message>
    <message>
        <source>second [ms]</source>
        <translation>zweiter [ms]</translation>
    </message>
    <message>
        <source>ratio</source>
        <translation>Verhältnis</translation>
    </message>
    <message>
        <source>Medians of both runs</source>
        <translation>Mediane beider Läufe</translation>
    </message>
    <message>
        <source>Median time of a frame behind the first, and second by first</source>
        <translation>Median der Zeit eines Bildes nach dem ersten, und zweiter durch ersten</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>There are not enough frames yet to tell the two apart.</source>
        <translation>Noch gibt es nicht genug Bilder, um die beiden zu unterscheiden.</translation>
    </message>
    <message>
        <source>%1 ms (%2 to %3)</source>
        <translation>%1 ms (%2 bis %3)</translation>
    </message>
    <message>
        <source>Medians at 95 %: %1 and %2</source>
        <translation>Mediane bei 95 %: %1 und %2</translation>
    </message>
    <message>
        <source>%1: no clear difference.</source>
        <translation>%1: kein klarer Unterschied.</translation>
    </message>
    <message>
        <source>%1: the second takes %2 % less.</source>
        <translation>%1: der zweite braucht %2 % weniger.</translation>
    </message>
    <message>
        <source>%1: the second takes %2 % more.</source>
        <translation>%1: der zweite braucht %2 % mehr.</translation>
    </message>
</context>
<context>
    <name>carom::SceneEditor</name>
    <message>
        <source>Scene text</source>
        <translation>Text der Szene</translation>
    </message>
</context>
<context>
    <name>carom::SceneLexer</name>
    <message>
        <source>Labels and white space</source>
        <translation>Namen und Leerraum</translation>
    </message>
    <message>
        <source>Comment</source>
        <translation>Kommentar</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>Zahl</translation>
    </message>
    <message>
        <source>Declaration</source>
        <translation>Deklaration</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Word or colour</source>
        <translation>Wort oder Farbe</translation>
    </message>
    <message>
        <source>Punctuation</source>
        <translation>Zeichensetzung</translation>
    </message>
    <message>
        <source>Unexpected characters</source>
        <translation>Unerwartete Zeichen</translation>
    </message>
</context>
<context>
    <name>carom::StabilityDock</name>
    <message>
        <source>Stability</source>
        <translation>Stabilität</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Ausgeben …</translation>
    </message>
    <message>
        <source>long forms</source>
        <translation>lange Formen</translation>
    </message>
    <message>
        <source>Write every figure as CSV</source>
        <translation>Jede Zahl als CSV schreiben</translation>
    </message>
    <message>
        <source>The cases as published, which take hours in all; otherwise their short forms</source>
        <translation>Die Fälle wie veröffentlicht, zusammen Stunden; sonst ihre kurzen Formen</translation>
    </message>
    <message>
        <source>Hard cases</source>
        <translation>Harte Fälle</translation>
    </message>
    <message>
        <source>Case</source>
        <translation>Fall</translation>
    </message>
    <message>
        <source>Right answer</source>
        <translation>Richtige Antwort</translation>
    </message>
    <message>
        <source>Default</source>
        <translation>Üblich</translation>
    </message>
    <message>
        <source>Accurate</source>
        <translation>Genau</translation>
    </message>
    <message>
        <source>Exact</source>
        <translation>Exakt</translation>
    </message>
    <message>
        <source>Double-click a case to open it as a scene, in the column&apos;s setting</source>
        <translation>Ein Doppelklick öffnet den Fall als Szene, in der Einstellung der Spalte</translation>
    </message>
    <message>
        <source>not run yet; it must hold: %1</source>
        <translation>noch nicht gelaufen; es muss gelten: %1</translation>
    </message>
    <message>
        <source>does not apply</source>
        <translation>trifft nicht zu</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message numerus="yes">
        <source>Run the %n selected</source>
        <translation>
            <numerusform>Den gewählten laufen lassen</numerusform>
            <numerusform>Die %n gewählten laufen lassen</numerusform>
        </translation>
    </message>
    <message>
        <source>Run all</source>
        <translation>Alle laufen lassen</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>holds</source>
        <translation>hält</translation>
    </message>
    <message>
        <source>fails</source>
        <translation>scheitert</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>Stopped. </source>
        <translation>Angehalten. </translation>
    </message>
    <message>
        <source>hard cases: %1</source>
        <translation>harte Fälle: %1</translation>
    </message>
</context>
<context>
    <name>carom::StudyRunner</name>
    <message>
        <source>Stopped: %1</source>
        <translation>Angehalten: %1</translation>
    </message>
</context>
<context>
    <name>carom::SweepCommands</name>
    <message>
        <source>Sweep this value…</source>
        <translation>Diesen Wert variieren …</translation>
    </message>
    <message>
        <source>Sweep it together with %1…</source>
        <translation>Zusammen mit %1 variieren …</translation>
    </message>
</context>
<context>
    <name>carom::SweepDock</name>
    <message>
        <source>Sweep</source>
        <translation>Variieren</translation>
    </message>
    <message>
        <source>Copy as command</source>
        <translation>Als Befehl kopieren</translation>
    </message>
    <message>
        <source>Copy the command that makes this sweep in a shell</source>
        <translation>Den Befehl kopieren, der dasselbe in einer Shell berechnet</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Show this chart together with the next one</source>
        <translation>Dieses Diagramm zusammen mit dem nächsten zeigen</translation>
    </message>
    <message>
        <source>Use these values</source>
        <translation>Diese Werte übernehmen</translation>
    </message>
    <message>
        <source>Hide the ghost</source>
        <translation>Schatten ausblenden</translation>
    </message>
    <message>
        <source>A sweep runs the scene with other numbers in its text and measures each run.
Right-click a number in the text, or a value in the inspector, and choose Sweep this value; the simulation above goes on meanwhile.</source>
        <translation>Hier läuft die Szene mit anderen Zahlen in ihrem Text, und jeder Lauf wird gemessen.
Klicken Sie mit der rechten Maustaste auf eine Zahl im Text oder einen Wert im Inspektor und wählen Sie „Diesen Wert variieren“; die Simulation oben läuft währenddessen weiter.</translation>
    </message>
    <message>
        <source>Write the values of the run chosen into the text</source>
        <translation>Die Werte des gewählten Laufs in den Text schreiben</translation>
    </message>
    <message>
        <source>Show the run chosen beside the scene no longer</source>
        <translation>Den gewählten Lauf nicht mehr neben der Szene zeigen</translation>
    </message>
    <message>
        <source>copied: %1</source>
        <translation>kopiert: %1</translation>
    </message>
    <message>
        <source>Folder as the command line writes it…</source>
        <translation>Ordner, wie ihn die Befehlszeile schreibt …</translation>
    </message>
    <message>
        <source>the values of run %1 stand in the text</source>
        <translation>die Werte von Lauf %1 stehen im Text</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pause</translation>
    </message>
    <message>
        <source>Go on</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Keep what was computed so far; the runs under way are begun anew later</source>
        <translation>Behalten, was schon berechnet ist; angefangene Läufe beginnen später neu</translation>
    </message>
    <message>
        <source>Make the runs that are missing</source>
        <translation>Die fehlenden Läufe berechnen</translation>
    </message>
    <message>
        <source>Make a run for each combination of values</source>
        <translation>Für jede Kombination von Werten einen Lauf berechnen</translation>
    </message>
    <message>
        <source>Say first what is varied and what is measured</source>
        <translation>Sagen Sie zuerst, was variiert und was gemessen wird</translation>
    </message>
    <message>
        <source>reading</source>
        <translation>wird gelesen</translation>
    </message>
    <message>
        <source>the sweep has %1 runs and the window makes at most %2; copy it as a command</source>
        <translation>es wären %1 Läufe, und das Fenster berechnet höchstens %2; kopieren Sie sie als Befehl</translation>
    </message>
    <message>
        <source>no sweep: %1</source>
        <translation>nichts variiert: %1</translation>
    </message>
    <message>
        <source>%1 of %2 runs</source>
        <translation>%1 von %2 Läufen</translation>
    </message>
    <message>
        <source>, %1 s left</source>
        <translation>, noch %1 s</translation>
    </message>
    <message>
        <source>%1 runs, %2 s of processor time</source>
        <translation>%1 Läufe, %2 s Rechenzeit</translation>
    </message>
    <message>
        <source>paused: %1 of %2 runs</source>
        <translation>angehalten: %1 von %2 Läufen</translation>
    </message>
    <message>
        <source>; %1 lost: not finite any more</source>
        <translation>; %1 verloren: nicht mehr endlich</translation>
    </message>
    <message>
        <source>; %1 faulty: their text has errors</source>
        <translation>; %1 fehlerhaft: ihr Text hat Fehler</translation>
    </message>
    <message>
        <source>sweep of %1: %2</source>
        <translation>%1 variiert: %2</translation>
    </message>
    <message>
        <source>There is no chart of this; export the table.</source>
        <translation>Davon gibt es kein Diagramm; exportieren Sie die Tabelle.</translation>
    </message>
    <message>
        <source>Click a point to see its run.</source>
        <translation>Klicken Sie auf einen Punkt, um seinen Lauf zu sehen.</translation>
    </message>
    <message>
        <source>kept</source>
        <translation>behalten</translation>
    </message>
    <message>
        <source>run %1</source>
        <translation>Lauf %1</translation>
    </message>
    <message>
        <source>lost: not finite any more</source>
        <translation>verloren: nicht mehr endlich</translation>
    </message>
    <message>
        <source>faulty: its text has errors</source>
        <translation>fehlerhaft: sein Text hat Fehler</translation>
    </message>
    <message>
        <source>nothing was swept yet; choose Sweep first</source>
        <translation>es wurde noch nichts variiert; wählen Sie zuerst „Variieren“</translation>
    </message>
    <message>
        <source>there is no chart of this sweep; its table can be exported</source>
        <translation>davon gibt es kein Diagramm; die Tabelle lässt sich exportieren</translation>
    </message>
    <message>
        <source>`%1` has the runs of another sweep; choose another folder</source>
        <translation>`%1` enthält andere Läufe; wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>the folder cannot be made</source>
        <translation>der Ordner lässt sich nicht anlegen</translation>
    </message>
    <message>
        <source>Folder for the sweep</source>
        <translation>Ordner für die Läufe</translation>
    </message>
    <message>
        <source>Chart</source>
        <translation>Diagramm</translation>
    </message>
    <message>
        <source>Which chart is shown</source>
        <translation>Welches Diagramm gezeigt wird</translation>
    </message>
    <message>
        <source>copied: %1; save the scene first, the command reads its file</source>
        <translation>kopiert: %1; speichern Sie die Szene zuerst, der Befehl liest ihre Datei</translation>
    </message>
    <message>
        <source>Click a cell to see its run.</source>
        <translation>Klicken Sie auf eine Zelle, um ihren Lauf zu sehen.</translation>
    </message>
</context>
<context>
    <name>carom::SweepForm</name>
    <message>
        <source>What is varied</source>
        <translation>Was variiert wird</translation>
    </message>
    <message>
        <source>What is measured</source>
        <translation>Was gemessen wird</translation>
    </message>
    <message>
        <source>Choose</source>
        <translation>Auswählen</translation>
    </message>
    <message>
        <source>Measures that suit what is varied</source>
        <translation>Maße, die zu dem passen, was variiert wird</translation>
    </message>
    <message>
        <source>together</source>
        <translation>zusammen</translation>
    </message>
    <message>
        <source>Frames of each run</source>
        <translation>Bilder jedes Laufs</translation>
    </message>
    <message>
        <source>as the scene says</source>
        <translation>wie die Szene</translation>
    </message>
    <message>
        <source>Seeds</source>
        <translation>Startwerte</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>Runs of each point, each with the next seed of the generated scene</source>
        <translation>Läufe je Punkt, jeder mit dem nächsten Startwert der erzeugten Szene</translation>
    </message>
    <message>
        <source>Draws</source>
        <translation>Ziehungen</translation>
    </message>
    <message>
        <source>Draws from laws such as `uniform 4:12` and `normal 8:0.5`</source>
        <translation>Ziehungen aus Verteilungen wie `uniform 4:12` und `normal 8:0.5`</translation>
    </message>
    <message>
        <source>Which numbers are varied, one a line: `first:last:count`, `log 1e-3:1:7`, a list `1,4,16` of numbers or words, or a law</source>
        <translation>Welche Zahlen variiert werden, eine je Zeile: `erster:letzter:Anzahl`, `log 1e-3:1:7`, eine Liste `1,4,16` von Zahlen oder Wörtern oder eine Verteilung</translation>
    </message>
    <message>
        <source>Which figures are taken from each run, one a line: `final y of ball`, `speed of ball at 1.5`, `first impact of a and b`</source>
        <translation>Was an jedem Lauf gemessen wird, eines je Zeile: `final y of ball`, `speed of ball at 1.5`, `first impact of a and b`</translation>
    </message>
    <message>
        <source>Values go together, first with first, instead of each with each</source>
        <translation>Werte gehen zusammen, der erste mit dem ersten, statt jeder mit jedem</translation>
    </message>
    <message>
        <source>Vary</source>
        <translation>Variiert</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Maß</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Bilder</translation>
    </message>
</context>
<context>
    <name>carom::Timeline</name>
    <message>
        <source>Timeline</source>
        <translation>Zeitleiste</translation>
    </message>
    <message>
        <source>frame %1, %2 s</source>
        <translation>Bild %1, %2 s</translation>
    </message>
    <message>
        <source> (not simulated yet)</source>
        <translation> (noch nicht simuliert)</translation>
    </message>
    <message>
        <source>
%1 new contacts</source>
        <translation>
%1 neue Kontakte</translation>
    </message>
    <message>
        <source>
a breakpoint held</source>
        <translation>
ein Haltepunkt traf zu</translation>
    </message>
    <message>
        <source>0 s</source>
        <translation>0 s</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>
up to %1 new contacts a frame</source>
        <translation>
bis zu %1 neue Kontakte je Bild</translation>
    </message>
    <message>
        <source>
the run went wrong here</source>
        <translation>
hier ging im Lauf etwas schief</translation>
    </message>
    <message>
        <source>
an expectation failed</source>
        <translation>
eine Erwartung wurde verfehlt</translation>
    </message>
</context>
<context>
    <name>carom::TimingDock</name>
    <message>
        <source>Timing</source>
        <translation>Zeiten</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Show two runs in one chart: one that was kept, and this one or another</source>
        <translation>Zwei Läufe in einem Diagramm zeigen: einen behaltenen, und diesen oder einen anderen</translation>
    </message>
    <message>
        <source>now [ms]</source>
        <translation>jetzt [ms]</translation>
    </message>
    <message>
        <source>mean</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>median</source>
        <translation>Median</translation>
    </message>
    <message>
        <source>p95</source>
        <translation>p95</translation>
    </message>
    <message>
        <source>p99</source>
        <translation>p99</translation>
    </message>
    <message>
        <source>max</source>
        <translation>max</translation>
    </message>
    <message>
        <source>Statistics of frame times</source>
        <translation>Statistik der Bildzeiten</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Behalten</translation>
    </message>
    <message>
        <source>Keep the times of this run to compare another one with them</source>
        <translation>Die Zeiten dieses Laufs behalten, um einen anderen mit ihnen zu vergleichen</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Einpassen</translation>
    </message>
    <message>
        <source>Fill the height with the frames shown, instead of always showing the lines of 1/60 and 1/30 s</source>
        <translation>Die Höhe mit den gezeigten Bildern füllen, statt immer die Linien von 1/60 und 1/30 s zu zeigen</translation>
    </message>
    <message>
        <source>there are no frames yet; run the simulation first</source>
        <translation>es gibt noch keine Bilder; zuerst die Simulation laufen lassen</translation>
    </message>
    <message>
        <source>run %1</source>
        <translation>Lauf %1</translation>
    </message>
    <message>
        <source>run %1: %2</source>
        <translation>Lauf %1: %2</translation>
    </message>
    <message>
        <source>kept %1; run again and choose Compare</source>
        <translation>%1 behalten; noch einmal laufen lassen und „Vergleichen“ wählen</translation>
    </message>
    <message>
        <source>%1 [ms]</source>
        <translation>%1 [ms]</translation>
    </message>
    <message>
        <source>Frame %1 at %2 s: %3 pairs, %4 contacts</source>
        <translation>Bild %1 bei %2 s: %3 Paare, %4 Kontakte</translation>
    </message>
    <message>
        <source>First frame: %1 ms (apart)</source>
        <translation>Erstes Bild: %1 ms (für sich)</translation>
    </message>
    <message>
        <source>Where the time of each frame goes</source>
        <translation>Wohin die Zeit jedes Bildes geht</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Simulation only</source>
        <translation>Nur Simulation</translation>
    </message>
    <message>
        <source>Leave the time of drawing out of the graph</source>
        <translation>Die Zeit des Zeichnens im Diagramm weglassen</translation>
    </message>
    <message>
        <source>Of the last %1 frames, without the first; rendering of those that were shown.
The boxes say what is in the graph, whose columns Ctrl+wheel widens and the wheel moves</source>
        <translation>Der letzten %1 Bilder, ohne das erste; Zeichnen derer, die gezeigt wurden.
Die Kästchen sagen, was im Diagramm steht; Strg+Rad verbreitert seine Spalten, das Rad verschiebt sie</translation>
    </message>
</context>
<context>
    <name>carom::TimingStrip</name>
    <message>
        <source>frame %1, %2 s: %3 ms</source>
        <translation>Bild %1, %2 s: %3 ms</translation>
    </message>
    <message>
        <source>Frame times</source>
        <translation>Bildzeiten</translation>
    </message>
    <message>
        <source>%1 ms; the line of 1/60 s lies %2 times higher</source>
        <translation>%1 ms; die Linie von 1/60 s liegt %2-mal höher</translation>
    </message>
    <message>
        <source>Run the simulation to see the time of every frame</source>
        <translation>Die Simulation laufen lassen, um die Zeit jedes Bildes zu sehen</translation>
    </message>
</context>
<context>
    <name>carom::TransportBar</name>
    <message>
        <source>Speed of the presentation, 0.01× to 100×; the step itself stays</source>
        <translation>Geschwindigkeit der Darstellung, 0,01× bis 100×; der Schritt selbst bleibt</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Geschwindigkeit</translation>
    </message>
    <message>
        <source>running</source>
        <translation>läuft</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>speed</source>
        <translation>Tempo</translation>
    </message>
    <message>
        <source>paused</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>beendet</translation>
    </message>
    <message>
        <source>seeking</source>
        <translation>sucht</translation>
    </message>
    <message>
        <source>max: %1</source>
        <translation>max: %1</translation>
    </message>
    <message>
        <source>max</source>
        <translation>max</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Max</source>
        <translation>Max</translation>
    </message>
</context>
<context>
    <name>carom::Video</name>
    <message>
        <source>the run stopped at %1 s</source>
        <translation>der Lauf hielt bei %1 s an</translation>
    </message>
    <message>
        <source>MP4 needs the program ffmpeg, which is not installed; GIF and PNG need nothing</source>
        <translation>MP4 braucht das Programm ffmpeg, das nicht installiert ist; GIF und PNG brauchen nichts</translation>
    </message>
    <message>
        <source>no folder for the pictures: %1</source>
        <translation>kein Ordner für die Bilder: %1</translation>
    </message>
    <message>
        <source>pictures of %1 × %2 pixels cannot be drawn here</source>
        <translation>Bilder von %1 × %2 Bildpunkten lassen sich hier nicht zeichnen</translation>
    </message>
    <message>
        <source>ffmpeg failed: %1</source>
        <translation>ffmpeg ist gescheitert: %1</translation>
    </message>
    <message>
        <source>it was cancelled; the picture made so far stays</source>
        <translation>abgebrochen; das bis dahin gemachte Bild bleibt</translation>
    </message>
    <message>
        <source>it was cancelled; the %1 pictures made so far stay</source>
        <translation>abgebrochen; die %1 bis dahin gemachten Bilder bleiben</translation>
    </message>
    <message>
        <source>a GIF shows %1 pictures a second at most</source>
        <translation>ein GIF zeigt höchstens %1 Bilder in der Sekunde</translation>
    </message>
    <message>
        <source>%1 pictures are too many; up to %2 can be numbered</source>
        <translation>%1 Bilder sind zu viele; bis zu %2 lassen sich nummerieren</translation>
    </message>
    <message>
        <source>there is no scene to record</source>
        <translation>Es gibt keine Szene aufzunehmen</translation>
    </message>
    <message>
        <source>a video ends after it begins, and begins at 0 s or later</source>
        <translation>Ein Video endet nach seinem Anfang und beginnt bei 0 s oder später</translation>
    </message>
    <message>
        <source>`%1` has no ending of a video; name it .gif, .mp4 or .png</source>
        <translation>„%1“ hat keine Endung eines Videos; .gif, .mp4 oder .png ist nötig</translation>
    </message>
    <message>
        <source>it was cancelled, and half a video is not kept</source>
        <translation>abgebrochen; ein halbes Video wird nicht behalten</translation>
    </message>
</context>
<context>
    <name>carom::ViewCommands</name>
    <message>
        <source>Go to its &amp;declaration</source>
        <translation>Zur &amp;Deklaration</translation>
    </message>
    <message>
        <source>&amp;Inspect</source>
        <translation>&amp;Inspektor</translation>
    </message>
</context>
<context>
    <name>carom::ViewCube</name>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Links</translation>
    </message>
    <message>
        <source>Bottom</source>
        <translation>Unten</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Hinten</translation>
    </message>
</context>
<context>
    <name>carom::Viewport</name>
    <message>
        <source>Viewport</source>
        <translation>Bild</translation>
    </message>
</context>
<context>
    <name>carom::Welcome</name>
    <message>
        <source>Welcome to Carom</source>
        <translation>Willkommen bei Carom</translation>
    </message>
    <message>
        <source>Show this at the start when there is no scene to go on with</source>
        <translation>Dies beim Start zeigen, wenn es keine Szene gibt, mit der es weitergeht</translation>
    </message>
    <message>
        <source>&amp;Close</source>
        <translation>&amp;Schließen</translation>
    </message>
    <message>
        <source>&lt;h1&gt;Carom&lt;/h1&gt;&lt;p&gt;Scenes of rigid bodies: written, watched, measured.&lt;/p&gt;</source>
        <translation>&lt;h1&gt;Carom&lt;/h1&gt;&lt;p&gt;Szenen starrer Körper: schreiben, ansehen, messen.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>Learn it in ten minutes</source>
        <translation>In zehn Minuten lernen</translation>
    </message>
    <message>
        <source>Empty scene</source>
        <translation>Leere Szene</translation>
    </message>
    <message>
        <source>Template or generator…</source>
        <translation>Vorlage oder Generator …</translation>
    </message>
    <message>
        <source>Open a file…</source>
        <translation>Datei öffnen …</translation>
    </message>
    <message>
        <source>Opened last</source>
        <translation>Zuletzt geöffnet</translation>
    </message>
    <message>
        <source>Gallery of scenes</source>
        <translation>Galerie der Szenen</translation>
    </message>
</context>
<context>
    <name>carom::Workbench</name>
    <message>
        <source>recovered the unsaved text of %1</source>
        <translation>den nicht gespeicherten Text von %1 wieder aufgenommen</translation>
    </message>
    <message>
        <source>%1: %2 bodies, %3 problems, built in %4 ms</source>
        <translation>%1: %2 Körper, %3 Probleme, gebaut in %4 ms</translation>
    </message>
    <message>
        <source>selected: %1</source>
        <translation>gewählt: %1</translation>
    </message>
    <message>
        <source>%1 should hold unsaved text and cannot be read; it stays where it is</source>
        <translation>%1 sollte ungespeicherten Text enthalten und lässt sich nicht lesen; die Datei bleibt, wo sie ist</translation>
    </message>
    <message>
        <source>Unsaved text was found that cannot be read; the Output panel says where it is</source>
        <translation>Ungespeicherter Text wurde gefunden, der sich nicht lesen lässt; das Feld „Ausgabe“ nennt den Ort</translation>
    </message>
    <message>
        <source>Unsaved text is not kept: %1</source>
        <translation>Ungespeicherter Text wird nicht gesichert: %1</translation>
    </message>
    <message>
        <source>unsaved text is kept again</source>
        <translation>ungespeicherter Text wird wieder gesichert</translation>
    </message>
    <message>
        <source>unsaved text cannot be kept for the case of a crash: %1</source>
        <translation>ungespeicherter Text lässt sich für den Fall eines Absturzes nicht sichern: %1</translation>
    </message>
    <message>
        <source>the text was not built: %1</source>
        <translation>der Text wurde nicht übersetzt: %1</translation>
    </message>
    <message>
        <source>that failed: %1</source>
        <translation>das ist fehlgeschlagen: %1</translation>
    </message>
    <message>
        <source>%1 does not look like a scene: it is no text</source>
        <translation>%1 sieht nicht wie eine Szene aus: es ist kein Text</translation>
    </message>
    <message>
        <source>%1 does not look like a scene: it has more than %2 errors</source>
        <translation>%1 sieht nicht wie eine Szene aus: mehr als %2 Fehler</translation>
    </message>
</context>
</TS>
