#!/bin/sh
# Stands in for OpenSCAD in tests/scad.rs, and does what the test says. A file, not written by the test: a program that
# was written a moment ago cannot always be run.
eval "$PRETEND"
