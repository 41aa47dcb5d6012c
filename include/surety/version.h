// SPDX-License-Identifier: GPL-3.0-or-later
//
// The version of the library. This is the only place where it is written: CMake, the command line
// and the reports read it from here.
#ifndef SURETY_VERSION_H
#define SURETY_VERSION_H

#define SURETY_VERSION_MAJOR 0        ///< changes with the whole
#define SURETY_VERSION_MINOR 1        ///< while the first is 0: counts incompatible changes
#define SURETY_VERSION_PATCH 0        ///< counts compatible ones
#define SURETY_VERSION_STRING "0.1.0" ///< the three of them

#endif // SURETY_VERSION_H
