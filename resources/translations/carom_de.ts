<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>ComparisonCharts</name>
    <message>
        <source>Broad-phase in each frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Whole step in each frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs tested in each frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>pairs tested</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>FrameParts</name>
    <message>
        <source>integrate</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>broad-phase</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>narrow-phase</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>respond</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>other</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>render</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Actions</name>
    <message>
        <source>&amp;File</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Simulation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;New</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin an empty scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>New from a &amp;template or generator…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Begin with a template, or with a scene made by a generator</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Open…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a scene file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open &amp;recent</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open one of the scenes opened last</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write the scene to its file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save &amp;as…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write the scene to another file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Re&amp;load</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Read the file again and give up what was changed here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save &amp;picture…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the window as a PNG file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Leave the program</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Take the last change back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make the change again that was taken back</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cu&amp;t</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Move the selection to the clipboard</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Copy the selection to the clipboard</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Insert what the clipboard holds</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select &amp;all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Select the whole text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Find and replace…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search the text, also with regular expressions</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find ne&amp;xt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the next place that matches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find pre&amp;vious</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the place before that matches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Go to line…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put the caret on a line by its number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pr&amp;eferences…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Theme, font, keys, navigation, memory and threads</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>C&amp;omplete</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>List what may stand at the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;What goes here</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the parameters of the declaration one is writing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Insert a declaration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Insert a whole declaration; Tab goes from value to value</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the &amp;definition</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the body whose label is at the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Rename the label…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the label at the caret another name wherever it stands</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the number &amp;up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Raise the number at the caret by one of its last decimal (Alt+wheel and Alt+drag, too)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Turn the number do&amp;wn</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lower the number at the caret by one of its last decimal (Alt+wheel and Alt+drag, too)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Toggle co&amp;mment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Comment the selected lines out, or in again</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Format the text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Lay the whole text out in the usual way; only white space changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Apply the f&amp;ix</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mend the problem at the caret the obvious way</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Next problem</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the next problem in the text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>P&amp;revious problem</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the problem before the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Run the simulation, or pause it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Step</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulate one frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Reset</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go back to the beginning, with the text as it is now</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Faster</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Double the speed of the presentation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>S&amp;lower</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Halve the speed of the presentation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Real &amp;time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>One second of the scene in one second</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As fast as &amp;possible</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulate without waiting for the clock</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Frame the selection</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring the selected body into view (F in the viewport)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame &amp;everything</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Bring the whole scene into view (Home in the viewport)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>World &amp;axes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the world&apos;s axes: x red, y green, z blue</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Boxes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the box that the broad-phase sees of each body</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Overlapping &amp;pairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the boxes that overlap and a line between their bodies</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Grid cells or tree nodes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the cells of the grid or the nodes of the tree that the broad-phase uses</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Velocities</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw the way of each body in a tenth of a second</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Contacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Draw points and normals where bodies touch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Labels</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write the labels of bodies over them</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Write</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrange the panels for writing a scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wat&amp;ch</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrange the panels for watching: a large picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>M&amp;easure</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrange the panels for measuring times and quantities</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stud&amp;y</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrange the panels for studies of accuracy and cost</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put the workspace bac&amp;k</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Arrange this workspace&apos;s panels as they came</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Larger te&amp;xt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make the editor&apos;s text larger</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>S&amp;maller text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Make the editor&apos;s text smaller</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Normal text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the editor&apos;s text its usual size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Messages in the te&amp;xt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show each problem&apos;s message under its line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Dark theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Switch between the dark and the light theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the e&amp;ditor</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put the keyboard into the text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to the vie&amp;wport</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Put the keyboard into the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Manual: the word at the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open the manual at what the word at the caret means</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Tutorial</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>From an empty scene to a measured answer in ten minutes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>All keys and what they do</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Welcome…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show the gallery of scenes and the files opened last</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Find a command…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Do anything the menus can do, by a few letters of its name</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;About Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Version and licence</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::BroadphaseComparison</name>
    <message>
        <source>`%1` cannot be written: %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What to compare on</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>on this scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Its first %1 frames with every algorithm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>against N: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 frames of the generated scene at growing numbers of bodies; takes minutes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Chart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write the chart or the figures to a file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare all runs the first %1 frames of the scene with every algorithm and shows what each took.
The simulation above goes on meanwhile.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export the chart</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV, a row an algorithm…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export the figures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>CSV, a row a frame…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export every frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stop</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Compare all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show what was computed so far</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1, about %2 s left</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>broad-phases compared in %1 s: %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopped before there was anything to compare.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median time of a step [ms] against the number of bodies N.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopped; median time of a step [ms] as far as it went.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 frames from the start: %2 was fastest.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopped. </source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> The scene has changed since.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What each algorithm took</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Means of the frames behind the first: of the broad-phase, the whole step, pairs tested, pairs overlapping, and tested for each overlapping</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Median time of a step [ms] behind the first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>nothing was compared yet; choose Compare all first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>there is no chart of so few figures</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>there are no single frames; compare all on this scene first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 files (*.%2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Written to %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not exported: %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::BroadphaseDock</name>
    <message>
        <source>Boxes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Boxes looked at in the frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Overlapping pairs</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs whose boxes overlap: what the narrow phase gets</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs tested</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs of boxes compared to find them</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Tested / overlapping</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 would be perfect</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs found touching or overlapping</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Swaps</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Exchanges of neighbouring end points (sweep and sort)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs added / removed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs that began and ceased to overlap</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells or nodes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Cells of a grid or nodes of a tree visited</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Memory</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Held by the algorithm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Axes tried</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pairs tried along the direction that parted them in the frame before</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Full tests spared</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the axes tried, those that still part the pair: no full test was needed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Wall time of the broad-phase in the frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Broad-phase</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Algorithm</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the scene asks</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>none</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the scene asks (%1)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The scene names it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Chosen: %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::CommandFinder</name>
    <message>
        <source>What do you want to do?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Commands</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> (on)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is called that.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::DiagnosticMarks</name>
    <message>
        <source>line %1: %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ctrl+. — %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Document</name>
    <message>
        <source>“%1” is a folder; choose a scene file in it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” cannot be read: %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” has %2 MiB; a scene&apos;s text may have 64 MiB</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>the text has no file yet; choose a name for it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” cannot be written: %2</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::EditCommands</name>
    <message>
        <source>Nothing at the caret has an obvious mend</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Go to line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line, 1 to %1:</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::EffectsDock</name>
    <message>
        <source>Effects</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The scene is empty.
Once there are bodies in it, this says which effects they call for, and why.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::FileCommands</name>
    <message>
        <source>opened %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unsaved changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” has changes that are not saved.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>new scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>new scene: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>saved %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the scene as</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reloaded %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>reloaded %1, which was changed outside</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Changed outside</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” was changed by another program, and here, too. Take the file&apos;s text and give up the changes made here?</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Save the window as a picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>“%1” cannot be written</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1[*] – Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1[*] (%2) – Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carom</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::FindBar</name>
    <message>
        <source>Find</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace by</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Regular e&amp;xpression</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Match &amp;case</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Previous</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Replace</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Replace &amp;all</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>not found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 match</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 matches</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1; went on from the top</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1; went on from the end</source>
        <translation type="unfinished"></translation>
    </message>
    <message numerus="yes">
        <source>%n replaced</source>
        <translation type="unfinished">
            <numerusform></numerusform>
            <numerusform></numerusform>
        </translation>
    </message>
</context>
<context>
    <name>carom::Frames</name>
    <message>
        <source>Timing</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>total</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>now [ms]</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>mean</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>median</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>p95</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>p99</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>max</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Statistics of frame times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fit</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Fill the height with the frames shown, instead of always showing the lines of 1/60 and 1/30 s</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Write the graph or its figures to a file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 [ms]</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame %1 at %2 s: %3 pairs, %4 contacts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>First frame: %1 ms (apart)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Of the last %1 frames, without the first; rendering of those that were shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Where the time of each frame goes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>`%1` cannot be written: %2</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>there are no frames yet; run the simulation first</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Export the timing graph</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 files (*.%2)</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Written to %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Not exported: %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::HelpCommands</name>
    <message>
        <source>About Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&lt;h3&gt;Carom %1&lt;/h3&gt;&lt;p&gt;Scenes of rigid bodies: written, watched, measured.&lt;/p&gt;&lt;p&gt;Free software under the GNU General Public License, version 3 or later.&lt;/p&gt;</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::LanguageCommands</name>
    <message>
        <source>The caret is in no declaration&apos;s braces</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no label at the caret; labels stand behind a body&apos;s type</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no number at the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>There is no label at the caret</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No body carries this label</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The text is laid out in the usual way already</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Laid out; Ctrl+Z takes it back</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::LivePreview</name>
    <message>
        <source>1 error: the last scene without is shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 errors: the last scene without is shown</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>1 error: the declaration it is in is left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 errors: the declarations they are in are left out</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The text has changed: Reset (Shift+F5) shows it</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::MainWindow</name>
    <message>
        <source>Tools</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show or hide this panel</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>line %1, column %2</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::ManualWindow</name>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Every key can be changed in the preferences. Alt with 1 to 9 goes to a panel, Esc back to the text. In the picture: the left button turns, the right one moves, the wheel zooms, F frames the selection, Home everything, Space plays.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Manual – Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ten minutes to a measured answer</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The scene language</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Reading a work–precision diagram</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Contents of the manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Manual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Search the manual</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::NewSceneDialog</name>
    <message>
        <source>New scene from a template or generator</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Templates and generators</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Create</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Templates</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Generators</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>How many</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The same seed gives the same scene on every machine</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Seed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 of text: too large to preview</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 bodies, %2 of text</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::OutlineDock</name>
    <message>
        <source>Outline</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find a declaration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Nothing is declared yet.
Ctrl+J inserts a declaration.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::OutlineModel</name>
    <message>
        <source>left out: there is a mistake in it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Name</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Type</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::OutputDock</name>
    <message>
        <source>Output</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What is opened, built, run and saved is noted here, with times.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Preferences</name>
    <message>
        <source>Left turns, right or middle moves</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Left turns, middle moves, right zooms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle turns, with Shift moves, with Ctrl zooms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Middle moves, with Shift turns; right zooms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Preferences</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Look</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Navigation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Simulation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Dark</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Light</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Theme</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> pt</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Font of the text</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Size</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>As the system</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Language</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The language changes at the next start. The scene language and its messages stay English.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Find a command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Command</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>A key that belongs to another command is taken from it.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Keys of “%1”</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Usual</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Give the command its usual keys</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Mouse in the picture</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The wheel zooms at the pointer and a click selects, whatever is chosen here.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source> MiB</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Memory for going back in time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>what the scene or the machine says</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Threads</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The motion does not depend on the number of threads.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::ProblemsDock</name>
    <message>
        <source>Problems</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>No problems.
What is wrong in the text is listed here as you type; F8 goes from one to the next.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Problems (%1)</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::ProblemsModel</name>
    <message>
        <source>Message</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Line</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Column</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Code</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::RecoveryDialog</name>
    <message>
        <source>Unsaved text found</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Carom ended unexpectedly. This text was typed and not saved; the lines that differ from the file are marked.</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unsaved texts</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>What the unsaved text changes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>a scene without a file</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Take it up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>T&amp;hrow it away</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Ask me &amp;later</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>The file holds this text already.</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::RenameBox</name>
    <message>
        <source>New name of the label</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter the new name; Esc gives up</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter renames it</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Enter renames it in %1 places</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::RunCommands</name>
    <message>
        <source>broad-phase: %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Play</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Stopped at frame %1: the %2 of %3 is no longer a finite number</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::SceneEditor</name>
    <message>
        <source>Scene text</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::SceneLexer</name>
    <message>
        <source>Labels and white space</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Comment</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Number</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Declaration</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Word or colour</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Punctuation</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Unexpected characters</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::TimingStrip</name>
    <message>
        <source>frame %1, %2 s: %3 ms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Frame times</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1 ms; the line of 1/60 s lies %2 times higher</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Run the simulation to see the time of every frame</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::TransportBar</name>
    <message>
        <source>Speed of the presentation, 0.01× to 100×; the step itself stays</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>running</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>frame</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>time</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>speed</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>paused</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>stopped</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Viewport</name>
    <message>
        <source>Viewport</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Welcome</name>
    <message>
        <source>Welcome to Carom</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Show this when the program starts without a scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&amp;Close</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>&lt;h1&gt;Carom&lt;/h1&gt;&lt;p&gt;Scenes of rigid bodies: written, watched, measured.&lt;/p&gt;</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Learn it in ten minutes</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Empty scene</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Template or generator…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Open a file…</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Opened last</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>Gallery of scenes</source>
        <translation type="unfinished"></translation>
    </message>
</context>
<context>
    <name>carom::Workbench</name>
    <message>
        <source>recovered the unsaved text of %1</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>%1: %2 bodies, %3 problems, built in %4 ms</source>
        <translation type="unfinished"></translation>
    </message>
    <message>
        <source>selected: %1</source>
        <translation type="unfinished"></translation>
    </message>
</context>
</TS>
