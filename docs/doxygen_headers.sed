# A header as Doxygen needs it. The comment at its top describes the file.
1,/^#pragma once/s|^//|///|
s|^#pragma once|/// @file|
# The first sentence is the brief description; "eq. (8)" does not end it.
/\/\/\//s/\<(eq|sec|Figs?)\. /\1.\\ /g
