// The icon font's names, kept apart because the bundle's header is where they come from.
#pragma once

#include <icons_font_awesome_6.h>
