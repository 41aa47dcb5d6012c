// SPDX-License-Identifier: GPL-3.0-or-later
//
// The source that the shared precompiled header is compiled for; it is empty on purpose.
