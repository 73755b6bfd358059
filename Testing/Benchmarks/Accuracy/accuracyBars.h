// The bars that measurements are held to.
#ifndef accuracyBars_h
#define accuracyBars_h

#include "accuracyMetrics.h"

namespace accuracy
{
/// Compares the rows with every bar, prints each with the worst row that it applies to, and adds a
/// row for it. False if a bar is missed, unless Documentation/Accuracy.md says so and by how much.
bool checkBars(Results& results);
}

#endif
