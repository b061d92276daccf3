"""The whole flow many times: on a folder (`batch`), at random (`generality`), on known results (`reproduction`)."""
