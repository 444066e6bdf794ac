#pragma once

// What a public header declares is seen from outside of the shared library; all else is hidden in
// it. A public header opens its namespace with this word, `namespace LYREFIT_PUBLIC lyrefit {`,
// and no other header does.
#define LYREFIT_PUBLIC [[gnu::visibility("default")]]
