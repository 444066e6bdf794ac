#pragma once

// What the page asks of the library: text in, text out. README.md says what both hold.

extern "C" {

// Does what a request in JSON asks for and answers in JSON, {"error": ...} where that cannot be done.
// Files are named as they lie in the working folder. The answer stays until the next call.
const char* lyrefit_run(const char* request);

// Given by who links this: is told where a fit or a diagnosis stands, a few times a second.
void lyrefit_progress(const char* progress);
}
