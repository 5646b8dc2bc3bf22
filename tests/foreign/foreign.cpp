// SPDX-License-Identifier: Apache-2.0
// A plugin library that is wrong in one respect, said by FOREIGN_*: the registry must refuse it
// with that reason and must not crash.
#include <vestige/abi.h>

#ifndef FOREIGN_MAGIC
#define FOREIGN_MAGIC ::vestige::kPluginMagic
#endif
#ifndef FOREIGN_SIZE
#define FOREIGN_SIZE sizeof(VestigePlugin)
#endif
#ifndef FOREIGN_MAJOR
#define FOREIGN_MAJOR ::vestige::kSdkMajor
#endif
#ifndef FOREIGN_TAG
#define FOREIGN_TAG ::vestige::kAbiTag
#endif

#ifdef FOREIGN_NOTHING
extern "C" __attribute__((visibility("default"))) const int something_else = 1;
#else
extern "C" __attribute__((visibility("default"))) const VestigePlugin vestige_plugin;
extern "C" const VestigePlugin vestige_plugin = {
    FOREIGN_MAGIC, FOREIGN_SIZE, FOREIGN_MAJOR, ::vestige::kSdkMinor,
    FOREIGN_TAG,   "brdf",       "foreign",     "1.0",
    nullptr,       nullptr,      nullptr,       0,
    nullptr};
#endif
