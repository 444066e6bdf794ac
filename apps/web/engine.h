#pragma once

// C interface of the library for the page: text in, text out. README.md describes both.

extern "C" {

// Runs a request in JSON and returns the answer in JSON, {"error": ...} on failure. File names
// refer to the working folder. The answer is valid until the next call.
const char* lyrefit_run(const char* request);

// Defined by the program that links the library: receives the progress of a fit or a diagnosis, a
// few times a second.
void lyrefit_progress(const char* progress);
}
