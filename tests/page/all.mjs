// All tests, in one process: they share the browser.
import { after } from 'node:test';
import { closeAll } from './support.mjs';
import './source.test.mjs';
import './model.test.mjs';
import './list.test.mjs';
import './rows.test.mjs';
import './strip.test.mjs';
import './case.test.mjs';
import './failures.test.mjs';
import './access.test.mjs';
import './speed.test.mjs';
import './play.test.mjs';
import './live.test.mjs';
import './serve.test.mjs';

after(closeAll);
