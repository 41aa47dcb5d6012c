// SPDX-License-Identifier: GPL-3.0-or-later
//
// The version of the library. This is the only place where it is written: CMake, the command line
// and the reports read it from here.
#ifndef SURETY_VERSION_H
#define SURETY_VERSION_H

#define SURETY_VERSION_MAJOR 0
#define SURETY_VERSION_MINOR 1
#define SURETY_VERSION_PATCH 0
#define SURETY_VERSION_STRING "0.1.0"

#endif // SURETY_VERSION_H
