"""The paper's claims, held against its own plots and against our rows."""
