//! RDT nodes and room map → actions.
