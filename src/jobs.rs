//! Worker threads and the job graph of the sea.
