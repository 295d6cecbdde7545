#pragma once

namespace armcal {

// What can be shown on a file descriptor, stdout (1) or stderr (2).
bool IsTerminal(int descriptor);
// A terminal that takes colours, and nobody asked for none (no-color.org).
bool TakesColour(int descriptor);
// Columns of the terminal; 80 where it is none.
int TerminalWidth(int descriptor);

}  // namespace armcal
